// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluate_report.h"

#include <fmt/format.h>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

ordered_json jsonOf(const Measures& m) {
    return {
        {"delta_e", m.deltaE}, {"delta_e_2000", m.deltaE2000}, {"rmse", m.rmse}, {"psnr", m.psnr}};
}

double number(const ordered_json& from, const char* key) {
    return from[key].get<double>();
}

/// Of single texels, over all pairs and over those that were not sampled.
std::string texelTableOf(const ordered_json& results) {
    std::string table =
        fmt::format("\n{:<12}{:<9}{:<11}|{:>8}{:>8}{:>8}{:>8} |{:>10}{:>8}\n", "texels", "plan",
                    "pairs", "dE76", "95 %", "PSNR", "95 %", "S-CIELAB", "SSIM");
    for (const ordered_json& r : results) {
        for (const auto& [pairs, from] :
             {std::pair<const char*, const ordered_json&>{"all", r},
              std::pair<const char*, const ordered_json&>{"unsampled", r["unsampled"]}}) {
            const ordered_json& t = from["texels"];
            table += fmt::format(
                "{:<12}{:<9}{:<11}|{:>8.2f}{:>8.2f}{:>8.1f}{:>8.1f} |{:>10.2f}{:>8.3f}\n",
                r["method"].get<std::string>(), r["plan"].get<std::string>(), pairs,
                number(t, "delta_e"), number(t, "delta_e_95"), number(t, "psnr"),
                number(t, "psnr_95"), number(t, "s_cielab"), number(t, "ssim"));
        }
    }
    return table;
}

}  // namespace

ordered_json jsonOf(const Accuracy& accuracy) {
    ordered_json json = jsonOf(accuracy.natural);
    json["stops"] = accuracy.stops;
    json["highlight"] = jsonOf(accuracy.highlight);
    json["pairs"] = accuracy.pairs;
    return json;
}

ordered_json jsonOf(const TexelMeasures& texels, const SeenMeasures& seen) {
    return {{"delta_e", texels.deltaE},  {"delta_e_95", texels.deltaE95}, {"psnr", texels.psnr},
            {"psnr_95", texels.psnr95},  {"s_cielab", seen.sCielab},      {"ssim", seen.ssim},
            {"images_seen", seen.images}};
}

std::string tableOf(const ordered_json& report) {
    std::string table = fmt::format("{}: {} pairs\n", report["input"].get<std::string>(),
                                    report["pairs"].get<std::size_t>());
    table += fmt::format("{:<12}{:<9}{:>8}{:>8} |{:>8}{:>8}{:>8}{:>8} |{:>8}{:>8} |{:>7}{:>12}\n",
                         "method", "plan", "samples", "images", "dE76", "dE2000", "RMSE", "PSNR",
                         "hi dE76", "hi PSNR", "stops", "us/ABRDF");
    for (const ordered_json& r : report["results"]) {
        table += fmt::format(
            "{:<12}{:<9}{:>8}{:>8} |{:>8.2f}{:>8.2f}{:>8.2f}{:>8.1f} |{:>8.2f}{:>8.1f} "
            "|{:>7.2f}{:>12.1f}\n",
            r["method"].get<std::string>(), r["plan"].get<std::string>(),
            r["samples"].get<std::size_t>(), r["images_read"].get<std::size_t>(),
            number(r, "delta_e"), number(r, "delta_e_2000"), number(r, "rmse"), number(r, "psnr"),
            number(r["highlight"], "delta_e"), number(r["highlight"], "psnr"), number(r, "stops"),
            number(r, "microseconds_per_abrdf"));
    }
    const ordered_json& results = report["results"];
    for (const ordered_json& r : results) {
        if (!r.contains("estimate")) continue;
        const ordered_json& e = r["estimate"];
        table += fmt::format(
            "{} {} expects at most {:.2f} dE76 of a texel (95 %: {:.2f}); {:.0f} % obey it\n",
            r["method"].get<std::string>(), r["plan"].get<std::string>(), number(e, "delta_e"),
            number(e, "delta_e_95"), 100 * number(e, "obeyed"));
    }
    if (!results.empty() && results[0].contains("texels")) table += texelTableOf(results);
    return table;
}

}  // namespace abrdf
