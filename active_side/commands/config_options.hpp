// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "capture/make_frame_source.hpp"
#include "commands/command.hpp"
#include "config/load.hpp"

namespace telehug {

// Which files and flags that are.
[[nodiscard]] ConfigSources config_sources(const ConfigOptions& options);

// Of the usual places, or of what the command line says instead.
[[nodiscard]] Result<ActiveConfig> load_config(const ConfigOptions& options);

[[nodiscard]] CaptureSettings capture_settings(const ActiveConfig& config);

}  // namespace telehug
