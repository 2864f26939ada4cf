// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/result.hpp"
#include "config/load.hpp"
#include "setup_run/setup_choice.hpp"

namespace telehug {

// Keeps camera, monitor and the screen's size for every later start: as the file active.d/50-setup.toml of the user's
// folder of configurations, which comes after their other files but those with a higher number; without such a folder,
// of the system's. It is there completely or not at all. The result is the file's name. The error says what to do: also
// if a start like this one would not read the file, or if another file or flag has the last word.
[[nodiscard]] Result<std::filesystem::path> remember_setup(const SetupChoice& choice, const ConfigSources& sources);

// What the file holds.
[[nodiscard]] std::string setup_fragment(const SetupChoice& choice);

}  // namespace telehug
