// SPDX-License-Identifier: Apache-2.0
#include "face/blaze_face_finder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>
#include <utility>

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr const char* model_name = "face_detection_back_256x256_barracuda.onnx";
constexpr const char* model_sha256 = "427cbbe0fc41448d09e1dc9cfabe2423d997cf2faaeab91fadd09a510b63b8e2";

constexpr int side_px = 256;  // of the square that the net looks at
const cv::Scalar beside(127, 127, 127);
constexpr double least_score = 0.5;
constexpr double same_face_overlap = 0.3;  // of two boxes, intersection over union

// From the net's box to the face between hairline and chin, means over labelled chat screens. Of the height: 1.27 over
// 54 screens, 1.24 where one face fills the picture; 1.235 keeps most faces within 15 % of the labels.
constexpr double face_heights_a_box = 1.235;
constexpr double chin_below_box = 0.01;        // in heights of the box
constexpr double face_widths_a_height = 0.72;  // cheek to cheek

// The net's answers: each of a grid of places tells the scores and boxes of a few anchors.
struct AnchorGrid {
  const char* scores;
  const char* boxes;
  int cells;  // a row and a column
  int anchors;
};
constexpr std::array grids{AnchorGrid{"Identity:0", "Identity_2:0", 16, 2},
                           AnchorGrid{"Identity_1:0", "Identity_3:0", 8, 6}};
constexpr int box_values = 16;  // x, y, width, height, then six points of the face

std::string sha256_of(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) return {};
  return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + size, ""));
}

// A picture in the middle of the net's square.
struct Letterbox {
  double scale = 1;  // pixels of the square per pixel of the picture
  double left_px = 0;
  double top_px = 0;

  explicit Letterbox(cv::Size picture)
      : scale(static_cast<double>(side_px) / std::max(picture.width, picture.height)),
        left_px((side_px - picture.width * scale) / 2),
        top_px((side_px - picture.height * scale) / 2) {}

  [[nodiscard]] cv::Rect2d in_picture(const cv::Rect2d& box) const {
    return {(box.x - left_px) / scale, (box.y - top_px) / scale, box.width / scale, box.height / scale};
  }
};

double overlap(const cv::Rect2d& a, const cv::Rect2d& b) {
  const double both = (a & b).area();
  return both > 0 ? both / (a.area() + b.area() - both) : 0;
}

// Boxes about the same face are averaged by their scores: that is steadier than the best of them.
FoundFaces merged(FoundFaces boxes) {
  std::ranges::sort(boxes, std::greater<>(), &FoundFace::score);
  FoundFaces faces;
  while (!boxes.empty()) {
    const FoundFace best = boxes.front();
    double weight = 0;
    cv::Rect2d sum;
    std::erase_if(boxes, [&](const FoundFace& box) {
      if (overlap(best.box, box.box) <= same_face_overlap) return false;
      sum.x += box.score * box.box.x;
      sum.y += box.score * box.box.y;
      sum.width += box.score * box.box.width;
      sum.height += box.score * box.box.height;
      weight += box.score;
      return true;
    });
    faces.push_back({{sum.x / weight, sum.y / weight, sum.width / weight, sum.height / weight}, best.score});
  }
  return faces;
}

cv::Rect2d calibrated(const cv::Rect2d& box) {
  const double height = box.height * face_heights_a_box;
  const double width = height * face_widths_a_height;
  const double chin_y = box.y + box.height * (1 + chin_below_box);
  return {box.x + box.width / 2 - width / 2, chin_y - height, width, height};
}

class BlazeFaceFinder final : public FaceFinder {
 public:
  explicit BlazeFaceFinder(cv::dnn::Net net) : net_(std::move(net)) {}

  [[nodiscard]] std::string name() const override { return "BlazeFace"; }

  Result<FoundFaces> find(const cv::Mat& bgr) override {
    if (bgr.empty()) return FoundFaces{};
    if (bgr.type() != CV_8UC3 && bgr.type() != CV_8UC4) {
      return Error{"The picture is not in 8-bit BGR or BGRX, so no face can be found in it."};
    }
    try {
      return find_in(bgr);
    } catch (const cv::Exception& exception) {
      return Error{
          fmt::format("The face net failed on a picture of {}x{} px: {}", bgr.cols, bgr.rows, exception.what())};
    }
  }

 private:
  FoundFaces find_in(const cv::Mat& bgr) {
    const Letterbox letterbox(bgr.size());
    prepare(bgr, letterbox);
    // Rows by columns by channels, as the net was exported from TensorFlow; blobFromImage puts channels first.
    net_.setInput(cv::Mat(4, std::array{1, side_px, side_px, 3}.data(), CV_32F, input_.data));
    const std::vector<cv::String> wanted{grids[0].scores, grids[0].boxes, grids[1].scores, grids[1].boxes};
    net_.forward(answers_, wanted);
    FoundFaces boxes;
    for (std::size_t i = 0; i < grids.size(); ++i)
      add_boxes(grids[i], answers_[2 * i].ptr<float>(), answers_[2 * i + 1].ptr<float>(), boxes);
    FoundFaces faces = merged(std::move(boxes));
    for (FoundFace& face : faces)
      face.box = calibrated(letterbox.in_picture(face.box));
    return faces;
  }

  // Halved until it is less than twice as large as needed, then interpolated: as good as averaging, and faster.
  void prepare(const cv::Mat& bgr, const Letterbox& letterbox) {
    cv::Mat picture = bgr;
    while (std::max(picture.cols, picture.rows) >= 2 * side_px && std::min(picture.cols, picture.rows) >= 2) {
      cv::Mat half;
      cv::resize(picture, half, {picture.cols / 2, picture.rows / 2}, 0, 0, cv::INTER_AREA);
      picture = half;
    }
    const cv::Rect inside(cvRound(letterbox.left_px), cvRound(letterbox.top_px),
                          std::max(1, cvRound(bgr.cols * letterbox.scale)),
                          std::max(1, cvRound(bgr.rows * letterbox.scale)));
    square_.create(side_px, side_px, bgr.type());
    square_.setTo(beside);
    const cv::Rect drawn = inside & cv::Rect(0, 0, side_px, side_px);
    cv::resize(picture, square_(drawn), drawn.size(), 0, 0, cv::INTER_LINEAR);
    cv::cvtColor(square_, rgb_, bgr.channels() == 4 ? cv::COLOR_BGRA2RGB : cv::COLOR_BGR2RGB);
    rgb_.convertTo(input_, CV_32F, 1 / 127.5, -1);
  }

  static void add_boxes(const AnchorGrid& grid, const float* scores, const float* values, FoundFaces& boxes) {
    const int count = grid.cells * grid.cells * grid.anchors;
    for (int i = 0; i < count; ++i) {
      const double score = 1 / (1 + std::exp(-static_cast<double>(scores[i])));
      if (score < least_score) continue;
      const int cell = i / grid.anchors;
      const double anchor_x = (cell % grid.cells + 0.5) / grid.cells * side_px;
      const double anchor_y = (cell / grid.cells + 0.5) / grid.cells * side_px;
      const float* const box = values + static_cast<std::ptrdiff_t>(i) * box_values;
      boxes.push_back({{anchor_x + box[0] - box[2] / 2, anchor_y + box[1] - box[3] / 2, box[2], box[3]}, score});
    }
  }

  cv::dnn::Net net_;
  cv::Mat square_, rgb_, input_;
  std::vector<cv::Mat> answers_;
};

}  // namespace

std::vector<fs::path> known_blaze_models() {
  return {fs::path(TELEHUG_INSTALLED_MODELS) / model_name, fs::path(TELEHUG_SOURCE_MODELS) / model_name};
}

Result<std::unique_ptr<FaceFinder>> make_blaze_face_finder(const std::vector<fs::path>& paths) {
  const auto found = std::ranges::find_if(paths, [](const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
  });
  if (found == paths.end()) {
    std::vector<std::string> tried;
    std::ranges::transform(paths, std::back_inserter(tried), [](const fs::path& path) { return path.string(); });
    return Error{fmt::format("The face model is missing (tried {}); install telehug again.", fmt::join(tried, ", "))};
  }
  std::ifstream file(*found, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (sha256_of(bytes) != model_sha256) {
    return Error{
        fmt::format("{} can't be read or is not the face model that belongs to telehug (its SHA-256 differs); "
                    "install telehug again.",
                    found->string())};
  }
  try {
    cv::dnn::Net net = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    return std::unique_ptr<FaceFinder>(std::make_unique<BlazeFaceFinder>(std::move(net)));
  } catch (const cv::Exception& exception) {
    return Error{fmt::format("OpenCV can't load the face model {}: {}", found->string(), exception.what())};
  }
}

}  // namespace telehug
