// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "calibration/calibration.hpp"
#include "common/result.hpp"
#include "finger/any_detector.hpp"
#include "touch/contact_tracker.hpp"

namespace telehug {

// Where the border strip lies in the upright pictures of this calibration.
[[nodiscard]] BorderStrip::Layout strip_layout(const Calibration& calibration);

// The background kept beside a calibration file. The error says that there is none, or what is wrong with it.
Result<BorderStrip> read_background_of(const std::filesystem::path& calibration_file, const Calibration& calibration);

// `choice`: "thesis" or "default", which learns the background by itself if there is none. For the calibration's
// upright pictures. With the default model it also looks for mirror images. Throws std::invalid_argument if no finger
// could be seen with this calibration.
AnyDetector make_detector(const std::string& choice, const Calibration& calibration,
                          const std::optional<BorderStrip>& background);

// Only the default detector with the default model can tell touching from hovering.
[[nodiscard]] TrackerOptions tracker_options(const Calibration& calibration, const AnyDetector& detector);

}  // namespace telehug
