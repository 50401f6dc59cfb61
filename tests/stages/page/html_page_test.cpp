// SPDX-License-Identifier: BSD-3-Clause
#include "stages/page/html_page.h"

#include <doctest/doctest.h>

#include <string>

using namespace abrdf;

namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

PageContent small() {
    PageContent content;
    content.title = "A <b>title</b> & \"more\"";
    content.view = {"a view", 2, std::vector<std::uint8_t>(24, 7)};
    PageMaterial material;
    material.name = "</script><script>alert(1)</script>";
    material.caption = "@DATA@ @TABLES@";
    material.picture = "jpeg";
    content.materials.push_back(material);
    content.tables.push_back(
        {"Table", "note", {"Name", "Value"}, {{"<i>", 0.123456789}, {nullptr, 3}}});
    return content;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a page is one file that asks for no other, and the same each time") {
    const std::string html = htmlPage(small());
    CHECK(html == htmlPage(small()));
    CHECK(html.substr(0, 15) == "<!DOCTYPE html>");
    for (const char* outside : {" src=\"http", "<link rel=\"stylesheet\"", "@import", "fetch(",
                                "XMLHttpRequest", "import("}) {
        CAPTURE(outside);
        CHECK(countOf(html, outside) == 0);
    }
    CHECK(countOf(html, "Leon Sorokin") > 0);
    CHECK(countOf(html, "public domain") > 0);
}

TEST_CASE("text stays text, and nothing of the content is taken for a part of the template") {
    const std::string html = htmlPage(small());
    CHECK(countOf(html, "alert(1)</script>") == 0);
    CHECK(countOf(html, "<b>title</b>") == 0);
    CHECK(countOf(html, "&lt;b&gt;title") == 2);
    CHECK(countOf(html, "@DATA@ @TABLES@") == 3);  // The picture's words, its caption, the data.
    CHECK(countOf(html, "&lt;i&gt;") == 1);
    CHECK(countOf(html, "data-sort=\"0.123456789\">0.1235<") == 1);
    // No place of the template is left.
    for (const char* place : {"@TITLE@", "@STYLE@", "@UPLOT@", "@VIEWER@"})
        CHECK(countOf(html, place) == 0);
}

TEST_CASE("places in the cube of a view and values are inverses, from 0 to 64") {
    CHECK(cubePlace(0) == 0);
    CHECK(cubeValue(1) == doctest::Approx(64).epsilon(1e-4));
    for (const double value : {0.001, 0.18, 1.0, 20.0}) {
        CHECK(cubeValue(cubePlace(value)) == doctest::Approx(value));
    }
    CHECK(cubePlace(-1) == 0);
}

TEST_SUITE_END();
