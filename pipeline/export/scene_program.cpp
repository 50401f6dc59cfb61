// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/export/scene_program.h"

#include "abrdf/output_file.h"
#include "stages/preview/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// A renderer that reads a material file of ours. `scene` takes {x}, {y}, {z}: towards the light, z
/// up, the viewer on the side of -y.
struct SceneProgram {
    const char* name;
    const char* format;
    bool hasSpectra;
    const char* material;
    const char* scene;
    const char* text;
    const char* run;
};

constexpr const char* kMitsuba = R"(<scene version="3.0.0">
  <integrator type="path"/>
  <sensor type="perspective">
    <float name="fov" value="28"/>
    <transform name="to_world">
      <lookat origin="0, -4, 2.2" target="0, 0, 0" up="0, 0, 1"/>
    </transform>
    <sampler type="multijitter"><integer name="sample_count" value="64"/></sampler>
    <film type="hdrfilm">
      <integer name="width" value="512"/>
      <integer name="height" value="512"/>
    </film>
  </sensor>
  <emitter type="directional">
    <vector name="direction" x="{mx:.6f}" y="{my:.6f}" z="{mz:.6f}"/>
    <rgb name="irradiance" value="3.141593"/>
  </emitter>
  <emitter type="constant"><rgb name="radiance" value="0.2"/></emitter>
  <shape type="sphere">
    <bsdf type="measured"><string name="filename" value="material.bsdf"/></bsdf>
  </shape>
</scene>
)";

// pbrt's own camera space is left-handed: without the first line it would show the mirror image.
constexpr const char* kPbrt = R"(Scale -1 1 1
LookAt 0 -4 2.2  0 0 0  0 0 1
Camera "perspective" "float fov" 28
Film "rgb" "string filename" "picture.exr" "integer xresolution" 512 "integer yresolution" 512
Sampler "zsobol" "integer pixelsamples" 64
Integrator "path"
WorldBegin
LightSource "distant" "point3 from" [ {x:.6f} {y:.6f} {z:.6f} ] "point3 to" [ 0 0 0 ]
    "rgb L" [ 1 1 1 ] "float scale" 3.141593
LightSource "infinite" "rgb L" [ 1 1 1 ] "float scale" 0.2
Material "measured" "string filename" "material.bsdf"
Shape "sphere" "float radius" 1
)";

// A source of 1 degree: pi / (pi sin(0.5 degrees)^2) shows a white Lambertian as 1.
constexpr const char* kRadiance = R"(void light sun
0
0
3 13131.6 13131.6 13131.6

sun source sun_disk
0
0
4 {x:.6f} {y:.6f} {z:.6f} 1

void glow sky
0
0
4 0.2 0.2 0.2 0

sky source sky_dome
0
0
4 0 0 1 360

void BSDF material
6 0 material.xml 0 0 1 .
0
0

material sphere ball
0
0
4 0 0 0 1
)";

constexpr std::array kPrograms{
    SceneProgram{"mitsuba", "rgl", true, "material.bsdf", "scene.xml", kMitsuba,
                 "mitsuba -m scalar_spectral scene.xml -o picture.exr"},
    SceneProgram{"pbrt", "rgl", true, "material.bsdf", "scene.pbrt", kPbrt, "pbrt scene.pbrt"},
    SceneProgram{"radiance", "radiance", false, "material.xml", "scene.rad", kRadiance,
                 "oconv scene.rad > scene.oct && rpict -ab 1 -vp 0 -4 2.2 -vd 0 4 -2.2 -vu 0 0 1 "
                 "-vh 28 -vv 28 scene.oct > picture.hdr"},
};

/// A scene's files are made in a folder within its own and put there when all are whole: a failed
/// job leaves neither some of them nor old ones changed.
class SceneFolder {
  public:
    explicit SceneFolder(fs::path folder) : folder_(std::move(folder)) {
        std::error_code error;
        if (!folder_.empty()) isNew_ = fs::create_directories(folder_, error);
        if (!error && !folder_.empty()) {
            fs::remove_all(unfinished(), error);  // Of a job that was killed.
            fs::create_directory(unfinished(), error);
        }
        if (!error && !folder_.empty()) return;
        throw std::runtime_error(fmt::format("'{}' cannot be made as a folder: {}",
                                             folder_.string(),
                                             error ? error.message() : "it has no name"));
    }
    SceneFolder(const SceneFolder&) = delete;
    SceneFolder& operator=(const SceneFolder&) = delete;
    ~SceneFolder() {
        std::error_code ignored;
        fs::remove_all(unfinished(), ignored);
        if (isNew_) fs::remove(folder_, ignored);  // Goes only where it is empty.
    }

    fs::path unfinished() const { return folder_ / ".abrdf-unfinished"; }

    void finish(const fs::path& input) const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(unfinished())) {
            files.push_back(entry.path());
            const fs::path target = folder_ / entry.path().filename();
            checkOutputPath(target, input);
        }
        for (const fs::path& file : files) fs::rename(file, folder_ / file.filename());
    }

  private:
    fs::path folder_;
    bool isNew_ = false;
};

ordered_json writeScene(const SceneProgram& program, const SceneJob& job,
                        const ProgressSink& progress) {
    ExportJob material = job.material;
    material.format = program.format;
    material.output = job.material.output / program.material;
    material.options.spectra = program.hasSpectra;
    ordered_json report = exportBrdf(material, progress);
    const Imath::V3d there = vectorFromAzimuthElevation(radiansFromDegrees(job.lightAzimuth),
                                                        radiansFromDegrees(job.lightElevation));
    // From previews' y up to z up.
    const Imath::V3d light(there.x, -there.z, there.y);
    // Braces of the text itself do not occur.
    writeWholeFile(
        job.material.output / program.scene,
        fmt::format(fmt::runtime(program.text), fmt::arg("x", light.x), fmt::arg("y", light.y),
                    fmt::arg("z", light.z), fmt::arg("mx", -light.x), fmt::arg("my", -light.y),
                    fmt::arg("mz", -light.z)));
    report["scene"] = program.scene;
    report["run"] = program.run;
    return report;
}

}  // namespace

std::vector<std::string> scenePrograms() {
    std::vector<std::string> names = {"blender"};
    for (const SceneProgram& program : kPrograms) names.emplace_back(program.name);
    return names;
}

ordered_json exportScene(const SceneJob& job, const ProgressSink& progress) {
    const auto found = std::ranges::find_if(
        kPrograms, [&](const SceneProgram& program) { return job.program == program.name; });
    if (found == kPrograms.end() && job.program != "blender") {
        throw std::invalid_argument(
            fmt::format("there is no scene for '{}'; there are:{}", job.program,
                        fmt::format(" {}", fmt::join(scenePrograms(), " "))));
    }
    const SceneFolder folder(job.material.output);
    SceneJob unfinished = job;
    unfinished.material.output = folder.unfinished();
    ordered_json report = job.program == "blender" ? writeBlenderScene(unfinished)
                                                   : writeScene(*found, unfinished, progress);
    folder.finish(job.material.input.input);
    return report;
}

}  // namespace abrdf
