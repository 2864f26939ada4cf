// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/calibration.hpp"
#include "capture/rig_directory.hpp"
#include "eval/failure.hpp"

namespace telehug {

// The surroundings of a failure in its frame, as the camera delivered them.
struct FailurePicture {
  Failure failure;
  std::vector<std::uint8_t> jpeg;
  ImageSize size;
  std::optional<ImagePoint> place_px;  // in this part of the frame; none if it is not in it
  std::optional<ImagePoint> found_px;
};

// As many of a kind may be asked for.
inline constexpr std::size_t failures_kept = 24;

// Frames that can't be read are left out.
[[nodiscard]] std::vector<FailurePicture> picture_failures(const std::vector<Failure>& failures,
                                                           const Calibration& calibration, const RigPart& part);

// `per_kind` of each kind at most, the biggest first; of two as big that of the lower frame.
[[nodiscard]] std::vector<FailurePicture> biggest(std::vector<FailurePicture> failures, std::size_t per_kind);

// `most` of them with equal shares for the kinds; what a kind does not need is shared by the others.
[[nodiscard]] std::vector<FailurePicture> share_out(const std::vector<FailurePicture>& failures, std::size_t most);

}  // namespace telehug
