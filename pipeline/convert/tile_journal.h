// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/lock_file.h"
#include "pipeline/convert/write_atlas.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// The manifest beside an unfinished atlas: of which job it is and which of its tiles are whole. It
/// says nothing that the atlas's own bytes do not confirm: each entry holds their hash, so that
/// neither a kill nor a power cut leaves a false one. A lock keeps a second process away.
class TileJournal {
  public:
    /// resume: continue what an earlier run of the same job left, of which then type(), written(),
    /// counts() and estimates() tell; else, or where there is nothing, begin anew.
    /// Throws std::runtime_error where another process writes `output`, or where the earlier job
    /// was another one, saying what changed.
    TileJournal(const std::filesystem::path& output, const nlohmann::ordered_json& job,
                PixelType type, bool resume);

    PixelType type() const { return type_; }
    const WrittenTiles& written() const { return written_; }
    const UnrealCounts& counts() const { return counts_; }
    /// Of the written tiles' texels, as TilesAdded has them.
    const std::vector<float>& estimates() const { return estimates_; }

    void add(const TilesAdded& added);

    /// Begins anew with another type.
    void restart(PixelType type);

    /// The atlas is finished, or given up: nothing of it stays unfinished.
    void remove();

    /// What a process left that was killed between putting `output` in place and remove().
    static void removeFinished(const std::filesystem::path& output);

  private:
    bool readBack();
    void begin();
    [[noreturn]] void fail(int error) const;

    std::filesystem::path output_;
    std::filesystem::path path_;
    LockFile lock_;
    nlohmann::ordered_json job_;
    PixelType type_;
    WrittenTiles written_;
    UnrealCounts counts_;
    std::vector<float> estimates_;
    std::ofstream stream_;
};

/// "rank was 16 and is 32, ...": the keys of two jobs that differ; empty where none does.
std::string differences(const nlohmann::ordered_json& was, const nlohmann::ordered_json& is);

}  // namespace abrdf
