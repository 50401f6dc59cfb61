// SPDX-License-Identifier: BSD-3-Clause
//
// UBO2003 (University of Bonn): a folder or zip of tvTTT_pvPPP/NNNNN tlTTT plPPP tvTTT pvPPP.jpg,
// 81 lights x 81 views, rectified photographs in sRGB, the cosine of theta_i in the values. The
// reader of every stack whose images have the four keys in their names and no other convention.
#include "stages/read/angle_keys.h"
#include "stages/read/database_path.h"

namespace abrdf {

bool recognizesUbo2003(const DatabasePath& path) {
    return path.files && firstNamedByAngles(*path.files).has_value();
}

std::unique_ptr<BtfReader> makeUbo2003Reader(const DatabasePath& path) {
    PhotographFormat format;
    format.name = "UBO2003";
    format.source = path.name();
    return makePhotographReader(path.files, photographsNamedByAngles(*path.files), format);
}

}  // namespace abrdf
