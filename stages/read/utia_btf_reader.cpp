// SPDX-License-Identifier: BSD-3-Clause
//
// UTIA BTF: folders tvTTT_pvPPP/ of tlTTT_plPPP_tvTTT_pvPPP.png (sRGB) or .exr (half, CIE XYZ under
// D65), the 81 directions of UBO2003. A camera stands in its own light, so the light of an image
// whose two directions are equal was moved to a place of its own (btf.utia.cas.cz, "Data
// description"). Such an image stands for its pair whether its name tells the pair or the place.
#include "stages/read/angle_keys.h"
#include "stages/read/database_path.h"
#include "stages/read/decode_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace abrdf {

namespace {

using Degrees = std::pair<double, double>;

Degrees lightOf(const Photograph& p) {
    return {p.thetaLight, p.phiLight};
}
Degrees viewOf(const Photograph& p) {
    return {p.thetaView, p.phiView};
}

/// "tl000_pl000_tv000_pv000.png": four keys in this order, with _ between them.
bool isUtiaName(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    std::string_view rest(path);
    if (slash != std::string::npos) rest.remove_prefix(slash + 1);
    for (const std::string_view key : {"tl", "_pl", "_tv", "_pv"}) {
        const auto same = [](char a, char b) {
            return std::tolower(static_cast<unsigned char>(a)) == b;
        };
        if (rest.size() < key.size() || !std::equal(key.begin(), key.end(), rest.begin(),
                                                    [&](char k, char c) { return same(c, k); })) {
            return false;
        }
        rest.remove_prefix(key.size());
        const auto number = numberAtBegin(rest);
        if (!number) return false;
        rest.remove_prefix(number->length);
    }
    return isImageName(path) && rest.starts_with('.');
}

/// Gives the images with a light of their own, where the pair of equal directions has none, to that
/// pair. Returns how many.
std::size_t unshiftLights(std::vector<Photograph>& photographs) {
    std::map<Degrees, std::size_t> imagesOfLight;
    std::set<Degrees> viewsWithEqualLight;
    for (const Photograph& p : photographs) {
        ++imagesOfLight[lightOf(p)];
        if (lightOf(p) == viewOf(p)) viewsWithEqualLight.insert(viewOf(p));
    }
    std::size_t moved = 0;
    for (Photograph& p : photographs) {
        const auto regular = imagesOfLight.find(viewOf(p));
        if (imagesOfLight[lightOf(p)] > 1 || regular == imagesOfLight.end() ||
            regular->second < 2 || !viewsWithEqualLight.insert(viewOf(p)).second) {
            continue;
        }
        std::tie(p.thetaLight, p.phiLight) = viewOf(p);
        ++moved;
    }
    return moved;
}

}  // namespace

bool recognizesUtiaBtf(const DatabasePath& path) {
    if (!path.files) return false;
    const auto first = firstNamedByAngles(*path.files);
    return first && isUtiaName(path.files->names()[*first]);
}

std::unique_ptr<BtfReader> makeUtiaBtfReader(const DatabasePath& path) {
    std::vector<Photograph> photographs = photographsNamedByAngles(*path.files);
    PhotographFormat format;
    format.name = "UTIA BTF";
    format.source = path.name();
    format.linearSpace = "CIE XYZ-D65 - Scene-referred";
    const std::size_t moved = unshiftLights(photographs);
    const auto equal = std::ranges::count_if(
        photographs, [](const Photograph& p) { return lightOf(p) == viewOf(p); });
    if (equal > 0) {
        format.notes.push_back(fmt::format(
            "in {} images light equals view; the database lit these from a place beside the camera "
            "({} of the names tell it, and stand for the pair all the same)",
            equal, moved));
    }
    return makePhotographReader(path.files, photographs, format);
}

}  // namespace abrdf
