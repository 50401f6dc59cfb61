// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "stages/reconstruct/reconstructor.h"

#include <atomic>

namespace abrdf {

ReconstructedTexels reconstructTexels(const AbrdfTile& samples, const AngularGrid& output,
                                      const Reconstructor& reconstructor) {
    ReconstructedTexels result{AbrdfTile(samples.texelCount(), output.pairCount()), 0, 0};
    std::atomic<std::uint64_t> clamped = 0;
    std::atomic<std::uint64_t> nonfinite = 0;
    forEachTexelBlock(samples.texelCount(), reconstructor.texelsAtOnce(),
                      [&](std::size_t begin, std::size_t end) {
                          const std::size_t pairs = output.pairCount();
                          const std::size_t count = samples.valuesPerTexel();
                          const std::span<Rgb> abrdfs =
                              result.abrdfs.values().subspan(begin * pairs, (end - begin) * pairs);
                          reconstructor.reconstruct(
                              samples.values().subspan(begin * count, (end - begin) * count),
                              abrdfs);
                          std::uint64_t below = 0;
                          std::uint64_t unreal = 0;
                          for (Rgb& value : abrdfs) {
                              if (value.r >= 0 && value.g >= 0 && value.b >= 0 && isFinite(value))
                                  continue;
                              if (!isFinite(value)) {
                                  ++unreal;
                                  value = {};
                              } else {
                                  ++below;
                                  value = {std::max(value.r, 0.0F), std::max(value.g, 0.0F),
                                           std::max(value.b, 0.0F)};
                              }
                          }
                          clamped += below;
                          nonfinite += unreal;
                      });
    result.clamped = clamped;
    result.nonfinite = nonfinite;
    return result;
}

}  // namespace abrdf
