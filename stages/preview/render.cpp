// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/render.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/lobe_profile.h"
#include "stages/preview/gathered_light.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

using Hits = std::vector<std::optional<SurfacePoint>>;

/// A texel of the map and its share in a point between texels.
struct TexelShare {
    int x = 0;
    int y = 0;
    float weight = 0;
};

int wrapped(int i, int n) {
    const int rest = i % n;
    return rest < 0 ? rest + n : rest;
}

/// The four texels around a point, as the map repeats; one where the map has one.
std::array<TexelShare, 4> texelsAt(const Material& material, const Scene& scene,
                                   const SurfacePoint& point) {
    const int wide = material.texelsWide();
    const int high = material.texelsHigh();
    if (wide == 1 && high == 1) return {{{0, 0, 1}, {}, {}, {}}};
    double across = scene.tiles * scene.surface->aspect() * high / wide;
    if (scene.surface->closesInU()) across = std::max(1.0, std::round(across));
    const double x = point.u * across * wide - 0.5;
    const double y = point.v * scene.tiles * high - 0.5;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    const auto tx = static_cast<float>(x - left);
    const auto ty = static_cast<float>(y - top);
    const int x0 = wrapped(left, wide);
    const int x1 = wrapped(left + 1, wide);
    const int y0 = wrapped(top, high);
    const int y1 = wrapped(top + 1, high);
    return {{{x0, y0, (1 - tx) * (1 - ty)},
             {x1, y0, tx * (1 - ty)},
             {x0, y1, (1 - tx) * ty},
             {x1, y1, tx * ty}}};
}

Rgb product(Rgb a, Rgb b) {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
}

/// The sum over texels and views; sumOf(row of lights, view) sums one row.
template <typename SumOf>
Rgb radiance(const Material& material, const Scene& scene, const SurfacePoint& point,
             const Imath::V3d& localView, const SumOf& sumOf) {
    Direction view = directionFromVector(localView);
    view.theta = std::min(view.theta, kPi / 2);
    const DirectionWeights views = material.views(view);
    Rgb sum;
    for (const TexelShare& texel : texelsAt(material, scene, point)) {
        if (texel.weight == 0) continue;
        for (std::size_t v = 0; v < views.terms.size(); ++v) {
            const std::size_t index = views.terms[v].index;
            const float weight = texel.weight * static_cast<float>(views.terms[v].weight);
            sum += weight * sumOf(material.row(texel.x, texel.y, index), index);
        }
    }
    return sum;
}

/// Shares of the single lights, each times the profile at its half angle: what is summed is then
/// the ratio to the profile at the nodes.
void addLobeShares(const Material& material, const Scene& scene, const SurfacePoint& point,
                   const Imath::V3d& localView, std::vector<LightShare>& shares) {
    for (const Light& light : scene.lights) {
        const Imath::V3d local = point.frame.local(light.direction);
        if (local.z <= 0) continue;
        const double visible = scene.surface->lightReaching(point, light.direction, light.softness);
        const double profile = material.lobe().at(halfAngleOf(local, localView));
        addShares(material, point.frame, light, visible * profile, shares);
    }
}

Rgb sumOfRatios(const Material& material, std::span<const Rgb> row, std::size_t view,
                const std::vector<LightShare>& shares) {
    const std::span<const float> inverse = material.inverseLobe(view);
    Rgb sum;
    for (const LightShare& s : shares) {
        sum += inverse[s.light] * product(s.strength, row[s.light]);
    }
    return sum;
}

/// Everything that shading needs beside the point; scratch memory is the caller's.
class Shader {
  public:
    Shader(const Material& material, const Scene& scene)
        : material_(material),
          scene_(scene),
          sky_(material, *scene.surface, scene.sky, scene.camera) {}

    Rgb shade(const SurfacePoint& point, const Imath::V3d& towardsCamera, std::vector<Rgb>& dense,
              std::vector<LightShare>& sparse) const {
        const Imath::V3d view = point.frame.local(towardsCamera);
        sparse.clear();
        addLobeShares(material_, scene_, point, view, sparse);
        dense.clear();
        if (!scene_.sky.empty()) {
            dense.resize(material_.lightCount());
            sky_.at(point.u, point.v, dense);
        }
        return radiance(material_, scene_, point, view,
                        [&](std::span<const Rgb> row, std::size_t viewIndex) {
                            Rgb sum = sumOfRatios(material_, row, viewIndex, sparse);
                            for (std::size_t i = 0; i < dense.size(); ++i) {
                                sum += product(dense[i], row[i]);
                            }
                            return sum;
                        });
    }

  private:
    const Material& material_;
    const Scene& scene_;
    GatheredLight sky_;
};

/// True where a pixel and a neighbour see different things, so that one sample is too few.
bool differ(const std::optional<SurfacePoint>& a, const std::optional<SurfacePoint>& b) {
    if (a.has_value() != b.has_value()) return true;
    if (!a) return false;
    return std::abs(a->distance - b->distance) > 0.04 || (a->frame.normal ^ b->frame.normal) < 0.9;
}

bool isEdge(const Hits& hits, int width, int height, int x, int y) {
    const auto at = [&](int column, int row) -> const std::optional<SurfacePoint>& {
        return hits[static_cast<std::size_t>(std::clamp(row, 0, height - 1)) *
                        static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(std::clamp(column, 0, width - 1))];
    };
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (differ(at(x, y), at(x + dx, y + dy))) return true;
        }
    }
    return false;
}

/// One pixel from side x side samples.
void sampleInto(Picture& picture, std::size_t pixel, int side, const Shader& shader,
                const Surface& surface, const Camera& camera) {
    thread_local std::vector<Rgb> dense;
    thread_local std::vector<LightShare> sparse;
    const auto width = static_cast<std::size_t>(picture.width);
    Rgb color;
    Imath::V3d normal(0);
    double depth = 0;
    int hits = 0;
    for (int i = 0; i < side * side; ++i) {
        const std::size_t row = pixel / width;
        const int subRow = i / side;
        const double x = static_cast<double>(pixel % width) + (i % side + 0.5) / side;
        const double y = static_cast<double>(row) + (subRow + 0.5) / side;
        const Ray ray = camera.rayThrough(x, y);
        const std::optional<SurfacePoint> point = surface.hit(ray);
        if (!point) continue;
        ++hits;
        color += shader.shade(*point, -ray.direction, dense, sparse);
        normal += point->frame.normal;
        depth += point->distance;
    }
    if (hits == 0) return;
    const float share = 1.0F / static_cast<float>(side * side);
    picture.color[pixel] = share * color;
    picture.alpha[pixel] = share * static_cast<float>(hits);
    picture.depth[pixel] = static_cast<float>(depth / hits);
    picture.normals[pixel] = Imath::V3f(normal.normalized());
}

}  // namespace

Picture render(const Material& material, const Scene& scene, int width, int height,
               const ProgressSink& progress) {
    constexpr int kMostPixels = 16384;
    if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels) {
        throw std::invalid_argument("a picture has 1 to 16384 pixels each way");
    }
    const Camera camera(scene.camera, width, height);
    const Shader shader(material, scene);
    Picture picture(width, height);
    Hits hits(picture.count());
    const auto columns = static_cast<std::size_t>(width);
    forEachTexel(hits.size(), [&](std::size_t i) {
        const std::size_t row = i / columns;
        hits[i] = scene.surface->hit(camera.rayThrough(static_cast<double>(i % columns) + 0.5,
                                                       static_cast<double>(row) + 0.5));
    });
    const bool textured = material.texelsWide() * material.texelsHigh() > 1;
    std::atomic<std::size_t> done = 0;
    forEachTexelBlock(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            for (std::size_t column = 0; column < columns; ++column) {
                const bool edge =
                    isEdge(hits, width, height, static_cast<int>(column), static_cast<int>(row));
                const std::size_t pixel = row * columns + column;
                if (!edge && !hits[pixel]) continue;
                sampleInto(picture, pixel,
                           edge       ? 4
                           : textured ? 2
                                      : 1,
                           shader, *scene.surface, camera);
            }
        }
        if (progress)
            progress({"render", "rows", done += end - begin, static_cast<std::size_t>(height)});
    });
    return picture;
}

Rgb radianceAt(const Material& material, const Scene& scene, const SurfacePoint& point,
               const Imath::V3d& towardsCamera) {
    const Imath::V3d view = point.frame.local(towardsCamera);
    std::vector<LightShare> ratios;
    addLobeShares(material, scene, point, view, ratios);
    std::vector<LightShare> shares;
    for (const Light& light : scene.sky) {
        addShares(material, point.frame, light,
                  scene.surface->skyReaching(point.u, point.v, light.direction), shares);
    }
    return radiance(material, scene, point, view,
                    [&](std::span<const Rgb> row, std::size_t viewIndex) {
                        Rgb sum = sumOfRatios(material, row, viewIndex, ratios);
                        for (const LightShare& s : shares) {
                            sum += product(s.strength, row[s.light]);
                        }
                        return sum;
                    });
}

}  // namespace abrdf
