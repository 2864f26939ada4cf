// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "face/blaze_face_finder.hpp"
#include "face/face_finder.hpp"

namespace telehug {

struct ChosenFaceFinder {
  std::unique_ptr<FaceFinder> finder;
  std::string note;  // why it is not the one that was asked for, for log and status; empty if it is
};

// `name`: blaze or haar. Where blaze can't be had the thesis' haar is taken instead, which sees fewer faces and takes
// longer. The error says why there is none at all.
Result<ChosenFaceFinder> make_face_finder(
    const std::string& name, const std::vector<std::filesystem::path>& blaze_models = known_blaze_models());

}  // namespace telehug
