// SPDX-License-Identifier: BSD-3-Clause
#include "stages/page/html_page.h"

#include "stages/page/page_assets.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

template <typename Value>
std::string base64(const std::vector<Value>& values) {
    return OIIO::Strutil::base64_encode(
        {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
}

std::string jpegUri(const std::string& bytes) {
    return bytes.empty() ? "" : "data:image/jpeg;base64," + OIIO::Strutil::base64_encode(bytes);
}

ordered_json jsonOf(const std::vector<PageRing>& rings) {
    ordered_json json = ordered_json::array();
    for (const PageRing& r : rings) json.push_back({r.theta, r.phi0, r.count, r.first});
    return json;
}

ordered_json jsonOf(const std::optional<PageTable>& table) {
    if (!table) return nullptr;
    return {{"lightRings", jsonOf(table->lightRings)},
            {"viewRings", jsonOf(table->viewRings)},
            {"lights", table->lights},
            {"views", table->views},
            {"cosineInside", table->cosineInside},
            {"lobe", table->lobe},
            {"halves", base64(table->halves)}};
}

ordered_json jsonOf(const PageMaterial& material) {
    return {{"name", material.name},
            {"caption", material.caption},
            {"reconstruction", jsonOf(material.reconstruction)},
            {"measurement", jsonOf(material.measurement)}};
}

ordered_json jsonOf(const PageEnvironment& environment) {
    std::vector<float> numbers;
    for (const PageLight& light : environment.lights) {
        for (const double d : {light.direction.x, light.direction.y, light.direction.z}) {
            numbers.push_back(static_cast<float>(d));
        }
        for (const float s : {light.strength.r, light.strength.g, light.strength.b}) {
            numbers.push_back(s);
        }
    }
    ordered_json json = {{"name", environment.name}, {"lights", base64(numbers)}, {"sun", nullptr}};
    if (environment.sun) {
        const auto& [d, s] = *environment.sun;
        json["sun"] = {d.x, d.y, d.z, s.r, s.g, s.b};
    }
    return json;
}

ordered_json jsonOf(const PageContent& content) {
    ordered_json json;
    json["title"] = content.title;
    json["exposure"] = content.exposure;
    json["background"] = content.background;
    json["view"] = {{"name", content.view.name},
                    {"side", content.view.side},
                    {"codes", base64(content.view.codes)}};
    json["materials"] = ordered_json::array();
    for (const PageMaterial& m : content.materials) json["materials"].push_back(jsonOf(m));
    json["environments"] = ordered_json::array();
    for (const PageEnvironment& e : content.environments) {
        json["environments"].push_back(jsonOf(e));
    }
    json["points"] = ordered_json::array();
    for (const PagePoint& p : content.points) {
        json["points"].push_back({{"method", p.method},
                                  {"input", p.input},
                                  {"microseconds", p.microseconds},
                                  {"deltaE", p.deltaE},
                                  {"samples", p.samples}});
    }
    return json;
}

std::string escaped(const std::string& text) {
    return OIIO::Strutil::replace(
        OIIO::Strutil::replace(
            OIIO::Strutil::replace(OIIO::Strutil::replace(text, "&", "&amp;", true), "<", "&lt;",
                                   true),
            ">", "&gt;", true),
        "\"", "&quot;", true);
}

/// Four digits where a number has more.
std::string cellText(const nlohmann::json& cell) {
    if (cell.is_null()) return "–";
    if (cell.is_string()) return escaped(cell.get<std::string>());
    if (cell.is_number_float()) return fmt::format("{:.4g}", cell.get<double>());
    return cell.dump();
}

std::string tableHtml(const PageDataTable& table, const std::string& id, bool isMatrix) {
    std::string html = fmt::format(
        "<section aria-labelledby=\"{0}\"><h2 id=\"{0}\">{1}</h2>\n<p class=\"note\">{2}</p>\n"
        "<div class=\"scroll\" role=\"group\" tabindex=\"0\" aria-labelledby=\"{0}\">"
        "<table class=\"{3}\"><thead><tr>",
        id, escaped(table.title), escaped(table.note),
        isMatrix ? "sortable asc matrix" : "sortable asc");
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const bool isNumber = std::ranges::any_of(
            table.rows, [&](const auto& row) { return row.size() > i && row[i].is_number(); });
        html += fmt::format("<th scope=\"col\"{}>{}</th>", isNumber ? " class=\"number\"" : "",
                            escaped(table.columns[i]));
    }
    html += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) {
            const nlohmann::json& cell = row[i];
            const std::string sort =
                cell.is_number() ? fmt::format(" class=\"number\" data-sort=\"{}\"", cell.dump())
                                 : std::string();
            html += i == 0 ? fmt::format("<th scope=\"row\" tabindex=\"-1\"{}>{}</th>", sort,
                                         cellText(cell))
                           : fmt::format("<td{}>{}</td>", sort, cellText(cell));
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div></section>\n";
}

/// What a browser without WebGL2 shows, and what the page is to those who cannot see it.
std::string picturesHtml(const PageContent& content) {
    std::string html;
    for (const PageMaterial& m : content.materials) {
        const bool alone = m.measuredPicture.empty();
        html += "<figure>";
        if (!alone) {
            html += fmt::format("<img alt=\"Sphere of {}, full measurement\" src=\"{}\">",
                                escaped(m.name), jpegUri(m.measuredPicture));
        }
        html += fmt::format("<img alt=\"Sphere of {}, {}\" src=\"{}\">", escaped(m.name),
                            escaped(m.caption), jpegUri(m.picture));
        html += fmt::format("<figcaption><b>{}</b> {}{}</figcaption></figure>\n", escaped(m.name),
                            escaped(m.caption), alone ? "" : " (left: full measurement)");
    }
    return html;
}

/// Replaces @NAME@; what is put in is not looked through again.
class Template {
  public:
    explicit Template(std::string_view text) : rest_(text) {}

    Template& with(const std::string& name, std::string_view value) {
        const std::string token = "@" + name + "@";
        const std::size_t at = rest_.find(token);
        if (at == std::string_view::npos) throw std::logic_error("the page has no place " + name);
        done_ += rest_.substr(0, at);
        done_ += value;
        rest_.remove_prefix(at + token.size());
        return *this;
    }
    std::string finish() const { return done_ + std::string(rest_); }

  private:
    std::string done_;
    std::string_view rest_;
};

}  // namespace

double cubePlace(double value) {
    return std::log2(1 + 1024 * std::max(value, 0.0)) / 16;
}

double cubeValue(double place) {
    return (std::exp2(16 * place) - 1) / 1024;
}

std::string htmlPage(const PageContent& content) {
    std::string tables;
    int number = 0;
    for (const PageDataTable& table : content.tables) {
        tables += tableHtml(table, fmt::format("table{}", ++number), false);
    }
    for (const PageDataTable& matrix : content.matrices) {
        tables += tableHtml(matrix, fmt::format("table{}", ++number), true);
    }
    // "</" would end the script element.
    const std::string data = OIIO::Strutil::replace(
        jsonOf(content).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "</",
        "<\\/", true);
    return Template(pageAsset("page.html"))
        .with("TITLE", escaped(content.title))
        .with("UPLOT_STYLE", pageAsset("uPlot.min.css"))
        .with("STYLE", pageAsset("page.css"))
        .with("HEADING", escaped(content.title))
        .with("PICTURES", picturesHtml(content))
        .with("TABLES", tables)
        .with("COLOR_NOTE", escaped(content.colorNote))
        .with("UPLOT_LICENSE", escaped(std::string(pageAsset("uPlot.LICENSE"))))
        .with("SORTABLE_LICENSE", escaped(std::string(pageAsset("sortable.LICENSE"))))
        .with("DATA", data)
        .with("UPLOT", pageAsset("uPlot.iife.min.js"))
        .with("SORTABLE", pageAsset("sortable.min.js"))
        .with("SORTABLE_A11Y", pageAsset("sortable.a11y.min.js"))
        .with("VERTEX_SHADER", pageAsset("sphere.vert"))
        .with("FRAGMENT_SHADER", pageAsset("sphere.frag"))
        .with("GATHER", pageAsset("gather.js"))
        .with("VIEWER", pageAsset("viewer.js"))
        .with("CHARTS", pageAsset("charts.js"))
        .finish();
}

}  // namespace abrdf
