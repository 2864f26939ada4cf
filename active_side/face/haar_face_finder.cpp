// SPDX-License-Identifier: Apache-2.0
#include "face/haar_face_finder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <system_error>

#include "face/checked_search.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

// Chosen on 54 labelled chat screens: a larger picture finds little more and takes three times as long, and without the
// equalised histogram dim faces are missed.
constexpr int search_width_px = 640;
constexpr double scale_step = 1.1;
constexpr int min_neighbours = 5;
constexpr double min_height_share = 0.07;  // of the picture's height, in the cascade's own boxes

// From the cascade's square to the face between hairline and chin, means over the same screens.
constexpr double face_heights_a_square = 1.12;
constexpr double chin_below_square = 0.05;     // in sides of the square
constexpr double face_widths_a_height = 0.72;  // cheek to cheek

cv::Rect2d calibrated(const cv::Rect& square, double px_per_search_px) {
  const double side = square.height * px_per_search_px;
  const double height = side * face_heights_a_square;
  const double width = height * face_widths_a_height;
  const double centre_x = (square.x + square.width / 2.0) * px_per_search_px;
  const double chin_y = (square.y + square.height) * px_per_search_px + chin_below_square * side;
  return {centre_x - width / 2, chin_y - height, width, height};
}

class HaarFaceFinder final : public FaceFinder {
 public:
  explicit HaarFaceFinder(const cv::CascadeClassifier& cascade) : cascade_(cascade) {}  // shares the loaded cascade

  [[nodiscard]] std::string name() const override { return "Haar"; }

  Result<FoundFaces> find(const cv::Mat& bgr) override {
    return checked_search(bgr, name(), [this](const cv::Mat& picture) { return find_in(picture); });
  }

 private:
  FoundFaces find_in(const cv::Mat& bgr) {
    const double px_per_search_px = std::max(1.0, static_cast<double>(bgr.cols) / search_width_px);
    const cv::Size search_size(std::max(1, cvRound(bgr.cols / px_per_search_px)),
                               std::max(1, cvRound(bgr.rows / px_per_search_px)));
    cv::resize(bgr, small_, search_size, 0, 0, cv::INTER_AREA);
    cv::cvtColor(small_, grey_, small_.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
    cv::equalizeHist(grey_, grey_);
    const int min_side = cvCeil(grey_.rows * min_height_share);
    cascade_.detectMultiScale(grey_, squares_, neighbours_, scale_step, min_neighbours, 0,
                              cv::Size(min_side, min_side));

    FoundFaces faces;
    for (std::size_t i = 0; i < squares_.size(); ++i) {
      faces.push_back({calibrated(squares_[i], px_per_search_px), neighbours_[i] / (neighbours_[i] + 1.0)});
    }
    return faces;
  }

  cv::CascadeClassifier cascade_;
  cv::Mat small_, grey_;
  std::vector<cv::Rect> squares_;
  std::vector<int> neighbours_;
};

}  // namespace

std::vector<fs::path> known_haar_cascades() {
  const fs::path name = "haarcascade_frontalface_default.xml";
  return {fs::path("/usr/share/opencv4/haarcascades") / name, fs::path("/usr/share/opencv/haarcascades") / name,
          fs::path("/usr/local/share/opencv4/haarcascades") / name};
}

Result<std::unique_ptr<FaceFinder>> make_haar_face_finder(const std::vector<fs::path>& paths) {
  const auto found = std::find_if(paths.begin(), paths.end(), [](const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
  });
  if (found == paths.end()) {
    std::vector<std::string> tried;
    std::transform(paths.begin(), paths.end(), std::back_inserter(tried),
                   [](const fs::path& path) { return path.string(); });
    return Error{fmt::format("The face cascade is missing (tried {}); install the package opencv-data.",
                             fmt::join(tried, ", "))};
  }
  cv::CascadeClassifier cascade;
  bool loaded = false;
  try {
    loaded = cascade.load(found->string()) && !cascade.empty();
  } catch (const cv::Exception&) {
    loaded = false;
  }
  if (!loaded) {
    return Error{fmt::format("{} is not a face cascade; install the package opencv-data again.", found->string())};
  }
  return std::unique_ptr<FaceFinder>(std::make_unique<HaarFaceFinder>(cascade));
}

}  // namespace telehug
