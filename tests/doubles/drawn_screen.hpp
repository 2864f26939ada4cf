// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core/mat.hpp>

struct spa_chunk;

namespace telehug {

// What a desktop is for PipeWire: a node that sends pictures when they change. It is linked to each stream that wants
// this node, as a session manager would do.
class DrawnScreen {
 public:
  enum class Format { bgrx, bgra, rgbx, rgba };
  struct Settings {
    cv::Size size{64, 48};
    Format format = Format::bgrx;
    int padding_bytes = 0;  // behind each row
  };

  // `pipewire_fd`: a connection, which becomes its own.
  DrawnScreen(int pipewire_fd, Settings settings);
  ~DrawnScreen();
  DrawnScreen(const DrawnScreen&) = delete;
  DrawnScreen& operator=(const DrawnScreen&) = delete;

  [[nodiscard]] std::uint32_t node() const;

  // Waits until somebody receives.
  bool is_watched();

  // Sends a picture: CV_8UC4 in BGRx, of the screen's size. Waits until there is a buffer for it. `lie` may change what
  // is said about it.
  bool show(const cv::Mat& bgrx, const std::function<void(spa_chunk&)>& lie = {});

  // Lets PipeWire hand on what it still holds: a picture that was sent before the receiver had done with the one before
  // waits for the next cycle, which a real desktop begins within a few milliseconds.
  void nudge();

  // As when the user chooses another resolution.
  void resize(cv::Size size);

  // What the receivers have agreed to; another one than before once they know of the new resolution.
  [[nodiscard]] cv::Size size() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace telehug
