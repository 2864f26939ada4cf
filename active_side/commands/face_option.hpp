// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/result.hpp"
#include "face/face_finder.hpp"

namespace CLI {
class App;
}

namespace telehug {

// `--face`, which finder is to look for faces.
void add_face_option(CLI::App& command, std::string& name);

// That finder. Where another one has to stand in for it, says so on stderr.
Result<std::unique_ptr<FaceFinder>> chosen_face_finder(const std::string& name);

}  // namespace telehug
