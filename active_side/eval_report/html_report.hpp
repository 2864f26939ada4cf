// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/result.hpp"
#include "eval_report/report.hpp"

namespace telehug {

// One HTML page that needs nothing else: no scripts, nothing from outside, pale or dark as the reader's desktop is. All
// text that comes from the evaluation is escaped.
[[nodiscard]] std::string html_report(const Report& report);

Status write_html_report(const std::filesystem::path& path, const Report& report);

}  // namespace telehug
