// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "capture/border_place.hpp"
#include "common/row_range.hpp"
#include "common/units.hpp"

namespace telehug {

enum class FrameVerdict : std::uint8_t {
  good,
  other_size,  // of another size than the calibration's, or no picture at all
  blank,       // black, white or all of one colour: covered, dazzled, or no signal
  torn,        // its lower part was never filled, or one part still shows the picture before
  frozen,      // the same picture again and again
  turned,      // upside down or mirrored, since earlier pictures were not
};

struct FrameFindings {
  FrameVerdict verdict = FrameVerdict::good;
  bool duplicate = false;  // every sample equals the frame before; cameras double frames in the dark
  // Share of the samples on the desk's side of the border that are clearly brighter or darker than in the frame before:
  // a finger and its hand change a part of them, a lamp all.
  double desk_change = 0;
  // The light changed in this frame or the few before: what seems to begin now may be the lamp's doing.
  bool settling = false;
};

struct FrameCheckOptions {
  // So many duplicates in a row are a camera that hangs (half a second at 30 frames/s). 0: pictures may stand still, as
  // those of a recording do; a camera's noise never does.
  int frozen_after = 15;
  // From this desk_change on the light has changed. A hand covers less than half of the desk that the camera sees.
  double light_change_from = 0.6;
  // For so many frames after it nothing new is believed: an automatic exposure takes some to follow.
  int settle_frames = 6;
};

// Looks whether a picture can be believed, before anybody looks for fingers in it; at a grid of 40 x 24 samples, which
// costs some us. A camera that was turned before the first picture can't be told from one that is calibrated so.
//
// Pictures of which only some rows were filled are checked in those. Whether the camera was turned is then only
// suspected, since a turned picture shows other things in these rows: see wants_whole_pictures(). Allocates nothing.
class FrameCheck {
 public:
  // `image`: the size of good pictures.
  FrameCheck(ImageSize image, BorderPlace border, const FrameCheckOptions& options = {});

  // The next frame; CV_8UC3, else it has another size. Only its `filled` rows are looked at.
  FrameFindings check(const cv::Mat& bgr, RowRange filled = {});

  // While it learns how good pictures look, and while they look so different that the camera may have been turned.
  [[nodiscard]] bool wants_whole_pictures() const noexcept {
    return reference_frames_ < reference_ready || looks_different_;
  }

 private:
  static constexpr int columns = 40;
  static constexpr int rows = 24;
  static constexpr int samples = columns * rows;
  static constexpr int reference_ready = 30;  // frames
  template <typename T>
  using Grid = std::array<T, samples>;

  // Rows of samples.
  struct SampleRows {
    std::size_t first = 0;
    std::size_t end = 0;
    [[nodiscard]] std::size_t count() const noexcept { return end - first; }
  };

  [[nodiscard]] SampleRows sample_rows(RowRange picture_rows) const;
  void sample(const cv::Mat& bgr);
  [[nodiscard]] bool is_blank() const;
  [[nodiscard]] bool is_torn() const;
  [[nodiscard]] bool is_turned();
  [[nodiscard]] double desk_change() const;
  void compare_rows();
  void follow_rows();
  void follow_reference();

  FrameCheckOptions options_;
  ImageSize image_;
  std::array<int, columns> u_px_{};
  std::array<int, rows> v_px_{};
  Grid<bool> on_desk_{};

  SampleRows here_;                // in this frame
  SampleRows compared_;            // in this frame and the one before
  Grid<std::uint32_t> colours_{};  // of this frame, blue, green and red in one number
  SampleRows before_;              // in the one before; none before the first
  Grid<std::uint32_t> colours_before_{};
  Grid<std::uint8_t> greys_{};
  Grid<std::uint8_t> greys_before_{};
  std::array<bool, rows> same_row_{};   // of those that are compared
  std::array<int, rows> lively_for_{};  // frames in a row in which this row of samples was another than before
  Grid<float> reference_{};             // how good pictures look
  int reference_frames_ = 0;            // whole ones
  bool looks_different_ = false;
  bool turned_ = false;
  int duplicates_ = 0;
  int settling_ = 0;
};

}  // namespace telehug
