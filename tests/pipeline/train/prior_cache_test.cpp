// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/train/prior_cache.h"

#include "abrdf/angular_grid.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// The cache is here while this lives.
class CacheIn {
  public:
    explicit CacheIn(const fs::path& folder) : old_(std::getenv("XDG_CACHE_HOME")) {
        setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    }
    ~CacheIn() { setenv("XDG_CACHE_HOME", old_.c_str(), 1); }
    CacheIn(const CacheIn&) = delete;
    CacheIn& operator=(const CacheIn&) = delete;

  private:
    std::string old_;
};

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a model is trained once, and once more where its file is damaged, with one warning") {
    const TemporaryFolder folder;
    const CacheIn cache(folder.path());
    const std::vector<LightAndView> pairs = pairsOf(AngularGrid(regularDirections(2, 3)));
    const PriorSource source{{}, {10, 1}};
    int trained = 0;
    std::vector<std::string> warnings;
    const auto get = [&] {
        return priorFor(
            pairs, pairs, source,
            [&](const ProgressTick& tick) { trained += tick.done == tick.total ? 1 : 0; },
            [&](const std::string& message) { warnings.push_back(message); });
    };
    const auto first = get();
    CHECK(trained == 1);
    CHECK(get()->classes[1].cross == first->classes[1].cross);
    CHECK(trained == 1);
    CHECK(warnings.empty());

    const fs::path file = cachedModel(*cacheFolder(), pairs, pairs, source.train);
    REQUIRE(fs::exists(file));
    fs::resize_file(file, fs::file_size(file) / 2);
    CHECK(get()->classes[1].cross == first->classes[1].cross);
    CHECK(trained == 2);
    CHECK(warnings.size() == 1);
    get();
    CHECK(trained == 2);
}

TEST_CASE("without a place to keep it a model is trained all the same") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "abrdf") << "a file where the folder should be";
    const CacheIn cache(folder.path());
    const std::vector<LightAndView> pairs = pairsOf(AngularGrid(regularDirections(2, 2)));
    std::vector<std::string> warnings;
    const auto model = priorFor(pairs, pairs, {{}, {5, 1}}, {},
                                [&](const std::string& message) { warnings.push_back(message); });
    CHECK(model->samples.size() == pairs.size());
    CHECK(warnings.size() == 1);
}

TEST_SUITE_END();
