// SPDX-License-Identifier: BSD-3-Clause
//
// A scene for Blender: a plane whose shader looks the spatial atlas up under one of its lights. Two
// images say for each direction of the viewer, as a stereographic map, which four views of the
// atlas it lies between, and their shares.
#include "abrdf/angular_interpolation.h"
#include "abrdf/output_file.h"
#include "pipeline/export/scene_program.h"
#include "pipeline/preview/shown_atlas.h"
#include "stages/preview/camera.h"
#include "stages/read/atlas_reader.h"
#include "stages/write/picture_exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// As a shell takes it for one word.
std::string quoted(const std::string& word) {
    constexpr const char* kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+/:,";
    if (word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

constexpr const char* kSpace = "Linear Rec.709 (sRGB)";
constexpr int kMapSide = 1024;

// Texels count from the top left; Blender's v from the bottom. Only what stands in {{ }} is
// Python's.
constexpr const char* kScript = R"(# Blender 3.4 or later: blender -b -P scene.py -- picture.exr
# A plane under one distant light of the atlas; emission is what the atlas holds.
import bpy, math, os, sys

here = os.path.dirname(os.path.abspath(__file__))
wide, high, views = {wide}, {high}, {views}  # Texels, and views of the atlas.
repeats = 1  # Of the map over the plane.

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
material = bpy.data.materials.new("atlas")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()


def put(socket, value):
    if hasattr(value, "is_output"):
        links.new(value, socket)
    else:
        socket.default_value = value


def math_node(operation, *inputs):
    node = nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, inputs):
        put(socket, value)
    return node.outputs[0]


def split(vector):
    node = nodes.new("ShaderNodeSeparateXYZ")
    put(node.inputs[0], vector)
    return node.outputs


def join(x, y):
    node = nodes.new("ShaderNodeCombineXYZ")
    put(node.inputs[0], x)
    put(node.inputs[1], y)
    return node.outputs[0]


def look_up(name, u, v):
    node = nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.load(os.path.join(here, name), check_existing=True)
    node.image.colorspace_settings.name = "Non-Color"  # Numbers as they are.
    node.image.alpha_mode = "NONE"
    node.interpolation = "Closest"
    put(node.inputs[0], join(u, v))
    return node.outputs["Color"]


# The viewer's direction on the plane, stereographic.
x, y, z = split(nodes.new("ShaderNodeNewGeometry").outputs["Incoming"])
scale = math_node("DIVIDE", 0.5, math_node("ADD", z, 1.0))
u = math_node("MULTIPLY_ADD", x, scale, 0.5)
v = math_node("MULTIPLY_ADD", y, scale, 0.5)
first = split(look_up("view_indices.exr", u, v))
shares = split(look_up("view_shares.exr", u, v))
fourth = split(look_up("view_fourth.exr", u, v))

# The texels around the place, from the top left, and their shares; the map repeats. Texels are square:
# the plane is as wide as the map is high.
def texels(place, count):
    at = math_node("MULTIPLY_ADD", place, float(repeats * high), -0.5)
    whole = math_node("FLOOR", at)
    share = math_node("SUBTRACT", at, whole)

    def wrapped(texel):
        return math_node("WRAP", texel, float(count), 0.0)

    if count == 1:
        return [(0.0, 1.0)]
    return [(wrapped(whole), math_node("SUBTRACT", 1.0, share)),
            (wrapped(math_node("ADD", whole, 1.0)), share)]


def vector_node(operation, *inputs):
    node = nodes.new("ShaderNodeVectorMath")
    node.operation = operation
    for socket, value in zip(node.inputs, inputs):
        put(socket, value)
    return node


place = split(nodes.new("ShaderNodeTexCoord").outputs["UV"])
total = None
for column, column_share in texels(place[0], wide):
    for row, row_share in texels(math_node("SUBTRACT", 1.0, place[1]), high):
        texel_share = math_node("MULTIPLY", column_share, row_share)
        v = math_node("SUBTRACT", 1.0, math_node("DIVIDE", math_node("ADD", row, 0.5), float(high)))
        for view, share in zip([*first[:3], fourth[0]], [*shares[:3], fourth[1]]):
            pixel = math_node("ADD", math_node("MULTIPLY_ADD", view, float(wide), column), 0.5)
            u = math_node("DIVIDE", pixel, float(wide * views))
            term = vector_node("SCALE", look_up("spatial.exr", u, v))
            put(term.inputs["Scale"], math_node("MULTIPLY", share, texel_share))
            total = term.outputs[0] if total is None else vector_node("ADD", total, term.outputs[0]).outputs[0]
emission = nodes.new("ShaderNodeEmission")
put(emission.inputs["Color"], total)
put(nodes.new("ShaderNodeOutputMaterial").inputs["Surface"], emission.outputs[0])

bpy.ops.mesh.primitive_plane_add(size=1.5)
bpy.context.object.data.materials.append(material)

# The camera of "abrdf preview --kind plane".
field, elevation = math.radians(25), math.radians(38)
distance = 1.06 * 0.88 / math.sin(field / 2)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.angle = field
camera.location = (0, -distance * math.cos(elevation), distance * math.sin(elevation))
camera.rotation_euler = (math.pi / 2 - elevation, 0, 0)
scene.collection.objects.link(camera)
scene.camera = camera

scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 32
scene.cycles.use_denoising = False
scene.cycles.use_adaptive_sampling = False
scene.cycles.pixel_filter_type = "BOX"
scene.render.resolution_x = scene.render.resolution_y = 512
scene.render.film_transparent = True
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.use_file_extension = False
if "--" in sys.argv:
    scene.render.filepath = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    bpy.ops.render.render(write_still=True)
)";

ExrPart::Channel channel(const char* name, std::vector<float> values) {
    return {name, std::move(values), false};
}

void writeRgb(const std::filesystem::path& path, int width, int height,
              const std::vector<Rgb>& pixels, bool isData) {
    std::array<std::vector<float>, 3> planes;
    for (const Rgb c : pixels) {
        planes[0].push_back(c.r);
        planes[1].push_back(c.g);
        planes[2].push_back(c.b);
    }
    ExrPart part;
    part.name = "rgb";
    part.width = width;
    part.height = height;
    part.channels = {channel("R", std::move(planes[0])), channel("G", std::move(planes[1])),
                     channel("B", std::move(planes[2]))};
    part.colorSpace = isData ? "" : kSpace;
    part.interopId = isData ? "data" : "lin_rec709_scene";
    writeExrParts(path, {part});
}

/// The four largest shares, which are all of them on a grid of rings.
std::array<DirectionWeights::Term, 4> fourTerms(DirectionWeights weights) {
    std::ranges::sort(weights.terms, std::greater<>(), &DirectionWeights::Term::weight);
    std::array<DirectionWeights::Term, 4> terms{};
    double sum = 0;
    for (std::size_t i = 0; i < std::min(terms.size(), weights.terms.size()); ++i) {
        terms[i] = weights.terms[i];
        sum += terms[i].weight;
    }
    for (auto& term : terms) term.weight /= sum;
    return terms;
}

void writeViews(const std::filesystem::path& folder, const AngularGrid& grid) {
    const AngularInterpolation views(grid.views());
    std::vector<Rgb> indices, shares, fourth;
    for (int row = 0; row < kMapSide; ++row) {
        for (int column = 0; column < kMapSide; ++column) {
            // From the rim on the horizon's views go on outwards.
            const double x = (column + 0.5) / kMapSide * 2 - 1;
            const double y = 1 - (row + 0.5) / kMapSide * 2;
            const double theta = std::min(2 * std::atan(std::hypot(x, y)), kPi / 2 - 1e-6);
            const auto t = fourTerms(views.weights({theta, wrappedAzimuth(std::atan2(y, x))}));
            const auto index = [&](std::size_t i) { return static_cast<float>(t[i].index); };
            const auto share = [&](std::size_t i) { return static_cast<float>(t[i].weight); };
            indices.push_back({index(0), index(1), index(2)});
            shares.push_back({share(0), share(1), share(2)});
            fourth.push_back({index(3), share(3), 0});
        }
    }
    writeRgb(folder / "view_indices.exr", kMapSide, kMapSide, indices, true);
    writeRgb(folder / "view_shares.exr", kMapSide, kMapSide, shares, true);
    writeRgb(folder / "view_fourth.exr", kMapSide, kMapSide, fourth, true);
}

/// The row of a spatial atlas that belongs to a light: for each view the map of all texels.
std::vector<Rgb> rowOf(const Atlas& atlas, std::size_t light) {
    const AtlasHeader& header = atlas.header();
    const double cosine =
        header.cosine == Cosine::kKept ? 1 : std::cos(header.grid.lights()[light].theta);
    std::vector<Rgb> pixels;
    for (int y = 0; y < header.layout.texelsHigh; ++y) {
        for (std::size_t view = 0; view < header.grid.views().size(); ++view) {
            for (int x = 0; x < header.layout.texelsWide; ++x) {
                const Rgb value = atlas.at({x, y, static_cast<int>(light), static_cast<int>(view)});
                pixels.push_back(isFinite(value) ? static_cast<float>(cosine) * value : Rgb{});
            }
        }
    }
    return pixels;
}

}  // namespace

ordered_json writeBlenderScene(const SceneJob& job) {
    const auto& folder = job.material.output;
    ordered_json report;
    report["description"] = "a scene for Blender";
    report["conversions"] = ordered_json::array();
    const fs::path& input = job.material.input.input;
    if (fs::exists(input) && !isAtlas(input)) {
        throw std::runtime_error(
            fmt::format("{}: is no atlas, and Blender's scene is made of one; make it first: abrdf "
                        "convert {} -o atlas.exr",
                        input.string(), quoted(input.string())));
    }
    const ColorConfig colors = ColorConfig::load(job.material.input.colorConfig);
    const Atlas atlas =
        atlasInSpace(job.material.input.input, colors, kSpace, report["conversions"]);
    const AngularGrid& grid = atlas.header().grid;
    const Imath::V3d wanted = vectorFromAzimuthElevation(radiansFromDegrees(job.lightAzimuth),
                                                         radiansFromDegrees(job.lightElevation));
    const std::size_t light =
        nearestDirection(grid.lights(), directionFromVector({wanted.x, -wanted.z, wanted.y}));
    const int wide = atlas.header().layout.texelsWide;
    const int high = atlas.header().layout.texelsHigh;
    const auto views = static_cast<int>(grid.views().size());
    writeRgb(folder / "spatial.exr", wide * views, high, rowOf(atlas, light), false);
    writeViews(folder, grid);
    writeWholeFile(folder / "scene.py",
                   fmt::format(fmt::runtime(kScript), fmt::arg("wide", wide),
                               fmt::arg("high", high), fmt::arg("views", views)));
    const Imath::V3d there = vectorFromDirection(grid.lights()[light]);
    // To a ten thousandth: what is below is of the grid's floats.
    const auto rounded = [](double degrees) { return std::round(1e4 * degrees) / 1e4; };
    const double azimuth = rounded(degreesFromRadians(std::atan2(there.x, -there.y)));
    const double elevation = rounded(90 - degreesFromRadians(grid.lights()[light].theta));
    report["light"] = {azimuth, elevation};
    report["scene"] = "scene.py";
    report["run"] = "blender -b -P scene.py -- picture.exr";
    report["preview"] = fmt::format("abrdf preview {} --kind plane --light {:g},{:g}{} -o same.exr",
                                    quoted(fs::absolute(input).string()), azimuth, elevation,
                                    wide * high > 1 ? " --tiles 1" : "");
    return report;
}

}  // namespace abrdf
