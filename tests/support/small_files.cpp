// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/small_files.h"

#include <half.h>

namespace abrdf {

ByteWriter& ByteWriter::scalar(double value, unsigned bytes) {
    if (bytes == 2) return put(Imath::half(static_cast<float>(value)).bits());
    if (bytes == 4) return put(static_cast<float>(value));
    return put(value);
}

double pairFactor(std::size_t row, std::size_t k) {
    return static_cast<double>((3 * row + 5 * k) % 13 + 1) / 16;
}

double texelFactor(std::size_t row, std::size_t k) {
    return static_cast<double>((7 * row + 3 * k) % 11 + 1) / 32;
}

namespace {

void putHeader(ByteWriter& out, const SmallBtf& btf) {
    ByteWriter metadata;
    metadata.put(std::uint32_t{4});
    metadata.text(std::string(240, '\0')).put(1.0F).put(2.0F).put(2.0F).put(2.0F);
    metadata.put(btf.cosineFlag).put(std::uint32_t{5}).text("<xml>").put(std::uint32_t{3});
    for (const char* channel : {"R", "G", "B"}) metadata.put(std::uint32_t{1}).text(channel);
    out.text(btf.signature);
    out.put(static_cast<std::uint32_t>(metadata.bytes().size() + 4)).text(metadata.bytes());
    const auto direction = [&](const Direction& d) {
        out.put(static_cast<float>(d.theta))
            .put(static_cast<float>(d.phi > kPi ? d.phi - 2 * kPi : d.phi));
    };
    out.put(static_cast<std::uint32_t>(btf.views.size()));
    for (const Direction& view : btf.views) {
        direction(view);
        out.put(static_cast<std::uint32_t>(btf.lights.size()));
        for (const Direction& light : btf.lights) direction(light);
    }
    out.put(btf.width).put(btf.height);
}

void putRotations(ByteWriter& out, const SmallBtf& btf) {
    out.put(btf.rotations);
    for (std::uint32_t i = 0; i < 9 * btf.rotations; ++i) out.put(0.5F);
}

void putFactors(ByteWriter& out, const SmallBtf& btf, std::size_t channels) {
    const std::size_t pairs = btf.lights.size() * btf.views.size();
    const std::size_t texels = std::size_t{btf.width} * btf.height;
    const bool images = btf.imagesAsColumns;
    const std::size_t pairRows = images ? pairs : channels * pairs;
    const std::size_t texelRows = images ? channels * texels : texels;
    const auto size = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
    out.put(static_cast<std::uint8_t>(btf.scalarBytes)).put(btf.components);
    out.put(size(images ? texelRows : pairRows)).put(size(images ? pairRows : texelRows));
    for (unsigned k = 0; k < btf.components; ++k) out.scalar(9, btf.scalarBytes);
    const auto matrix = [&](std::size_t rows, auto entry) {
        for (std::size_t r = 0; r < rows; ++r) {
            for (unsigned k = 0; k < btf.components; ++k) out.scalar(entry(r, k), btf.scalarBytes);
        }
    };
    if (images) matrix(texelRows, texelFactor);
    matrix(pairRows, pairFactor);
    if (!images) matrix(texelRows, texelFactor);
}

void putPvf(ByteWriter& out, const SmallBtf& btf) {
    const std::size_t texels = std::size_t{btf.width} * btf.height;
    const std::size_t size = 3 * (btf.imagesAsColumns ? texels : btf.lights.size());
    const std::size_t weights = btf.imagesAsColumns ? btf.lights.size() : texels;
    out.put(btf.components).put(static_cast<std::uint32_t>(btf.views.size()));
    for (std::size_t v = 0; v < btf.views.size(); ++v) {
        out.put(static_cast<std::uint8_t>(btf.scalarBytes)).put(btf.components);
        out.put(static_cast<std::uint32_t>(weights)).put(static_cast<std::uint32_t>(size));
        for (unsigned k = 0; k < btf.components; ++k) out.scalar(9, btf.scalarBytes);
        for (std::size_t i = 0; i < size; ++i) out.scalar(static_cast<double>(v), btf.scalarBytes);
        for (std::size_t i = 0; i < size; ++i) {
            for (unsigned k = 0; k < btf.components; ++k) {
                out.scalar(pairFactor(i, k), btf.scalarBytes);
            }
        }
        for (std::size_t i = 0; i < weights; ++i) {
            for (unsigned k = 0; k < btf.components; ++k) {
                out.scalar(texelFactor(i, k), btf.scalarBytes);
            }
        }
    }
}

/// Value of stored texel s, pair a, channel c: pairFactor(a, c) + s. One line of texels a chunk.
void putBdi(ByteWriter& out, const SmallBtf& btf) {
    const std::size_t texels = std::size_t{btf.width} * btf.height;
    const std::size_t pairs = btf.lights.size() * btf.views.size();
    out.put(std::uint32_t{1}).put(static_cast<std::uint8_t>(btf.mask.empty() ? 0 : 2));
    std::size_t stored = 0;
    for (std::size_t t = 0; t < texels; ++t) {
        const std::uint8_t flag = btf.mask.empty() ? 1 : btf.mask[t];
        out.put(flag);
        stored += flag;
    }
    putRotations(out, btf);
    for (std::size_t first = 0; first < stored; first += btf.width) {
        out.put(static_cast<std::uint32_t>(6 * pairs * btf.width));  // The last one is padded.
        for (std::size_t s = first; s < first + btf.width; ++s) {
            for (std::size_t a = 0; a < pairs; ++a) {
                for (std::size_t c = 0; c < 3; ++c) {
                    out.scalar(s < stored ? pairFactor(a, c) + static_cast<double>(s) : 0, 2);
                }
            }
        }
    }
}

}  // namespace

std::string btfBytes(const SmallBtf& btf) {
    ByteWriter out;
    putHeader(out, btf);
    if (btf.signature.starts_with("!BDI")) {
        putBdi(out, btf);
        return out.bytes();
    }
    if (btf.signature.ends_with('R')) putRotations(out, btf);
    if (btf.signature.starts_with("!DFMF")) {
        out.put(btf.components).put(btf.colorModel);
        for (const float m : btf.mean) out.put(m);
        for (const float m : btf.matrix) out.put(m);
        for (int c = 0; c < 3; ++c) putFactors(out, btf, 1);
    } else if (btf.signature.starts_with("!FMF")) {
        if (btf.signature == "!FMF12FCER") {
            out.put(std::uint8_t{2}).put(btf.logarithm);
            out.put(std::uint32_t{2}).put(std::uint32_t{1}).put(std::uint32_t{0});
        }
        out.put(btf.components);
        putFactors(out, btf, 3);
    } else {
        putPvf(out, btf);
    }
    return out.bytes();
}

std::string rglBytes(const SmallRgl& rgl) {
    struct Field {
        std::string name;
        std::uint8_t type;
        std::vector<std::uint64_t> sizes;
        std::string data;
    };
    const std::uint64_t phis = rgl.phiIn.size();
    const std::uint64_t thetas = rgl.thetaIn.size();
    const auto floats = [](const std::vector<float>& values) {
        ByteWriter out;
        for (const float v : values) out.put(v);
        return out.bytes();
    };
    std::vector<float> colors;
    for (std::uint64_t p = 0; p < phis; ++p) {
        const float red = rgl.red + rgl.redStep * static_cast<float>(p);
        for (std::uint64_t t = 0; t < thetas; ++t) {
            for (const float factor : {1.0F, 2.0F, 3.0F})
                colors.insert(colors.end(), 4, factor * red);
        }
    }
    const std::vector<Field> fields = {
        {"phi_i", 10, {phis}, floats(rgl.phiIn)},
        {"theta_i", 10, {thetas}, floats(rgl.thetaIn)},
        {"ndf", 10, {2, 2}, floats(std::vector<float>(4, rgl.ndf))},
        {"sigma", 10, {2, 2}, floats(std::vector<float>(4, rgl.sigma))},
        {"vndf", 10, {phis, thetas, 2, 2}, floats(std::vector<float>(4 * phis * thetas, 3))},
        {"rgb", 10, {phis, thetas, 3, 2, 2}, floats(colors)},
        {"jacobian", 1, {1}, std::string(1, rgl.jacobian ? '\1' : '\0')}};
    std::uint64_t offset = 18;
    for (const Field& f : fields) offset += 2 + f.name.size() + 2 + 1 + 8 + 8 * f.sizes.size();
    ByteWriter head;
    ByteWriter data;
    head.text(std::string("tensor_file\0", 12)).put(std::uint8_t{1}).put(std::uint8_t{0});
    head.put(static_cast<std::uint32_t>(fields.size()));
    for (const Field& f : fields) {
        head.put(static_cast<std::uint16_t>(f.name.size())).text(f.name);
        head.put(static_cast<std::uint16_t>(f.sizes.size())).put(f.type);
        head.put(offset + data.bytes().size());
        for (const std::uint64_t size : f.sizes) head.put(size);
        data.text(f.data);
    }
    return head.bytes() + data.bytes();
}

std::string mbsdfBytes(unsigned thetas, unsigned phis, std::uint32_t type) {
    ByteWriter out;
    out.text("NVIDIA ARC MBSDF V1\nMBSDF_DATA_REFLECTION=\n").put(type).put(thetas).put(phis);
    for (unsigned i = 0; i < thetas; ++i) {
        for (unsigned o = 0; o < thetas; ++o) {
            for (unsigned p = 0; p < phis; ++p) {
                out.put(static_cast<float>(i + 1));
                if (type == 1) out.put(static_cast<float>(o + 1)).put(static_cast<float>(p + 1));
            }
        }
    }
    return out.bytes();
}

std::string hdrBytes(const std::string& sizeLine, unsigned pixels) {
    ByteWriter out;
    out.text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + sizeLine + "\n");
    for (unsigned k = 0; k < pixels; ++k) {
        out.put(static_cast<std::uint8_t>(128 + k)).put(std::uint8_t{128});
        out.put(std::uint8_t{128}).put(std::uint8_t{128});
    }
    return out.bytes();
}

}  // namespace abrdf
