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

#include "common/data_folder.hpp"
#include "face/checked_search.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

constexpr const char* model_name = "face_detection_back_256x256_barracuda.onnx";
constexpr const char* model_sha256 = "427cbbe0fc41448d09e1dc9cfabe2423d997cf2faaeab91fadd09a510b63b8e2";

constexpr int side_px = 256;  // of the square that the net looks at
const cv::Scalar beside(127, 127, 127);
constexpr double least_score = 0.5;
constexpr double same_face_overlap = 0.3;  // of two boxes, intersection over union

// From the net's answer to the face between hairline and chin, fitted to 33 faces of labelled chat screens (every
// picture judged by the others): a longer way from nose to mouth makes a longer face. By the box alone a tenth of the
// heights is off by more than 0.17, with it by more than 0.14.
constexpr double heights_a_box = 2.0;
constexpr double nose_mouth_power = 0.3;
constexpr double least_nose_mouth = 0.15;  // in heights of the box; what lies outside is no face that anybody has
constexpr double most_nose_mouth = 0.28;
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
constexpr int box_values = 16;  // x, y, width, height, then eyes, nose, mouth and ears, x and y each
constexpr int nose_value = 8;
constexpr int mouth_value = 10;

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

// What one anchor says, px of the net's square.
struct Answer {
  double score = 0;
  cv::Rect2d box;
  double nose_mouth = 0;
};

// Answers about the same face are averaged by their scores: that is steadier than the best of them.
std::vector<Answer> merged(std::vector<Answer> answers) {
  std::ranges::sort(answers, std::greater<>(), &Answer::score);
  std::vector<Answer> faces;
  while (!answers.empty()) {
    const Answer best = answers.front();
    double weight = 0;
    Answer sum{best.score, {}, 0};
    std::erase_if(answers, [&](const Answer& answer) {
      if (overlap(best.box, answer.box) <= same_face_overlap) return false;
      sum.box.x += answer.score * answer.box.x;
      sum.box.y += answer.score * answer.box.y;
      sum.box.width += answer.score * answer.box.width;
      sum.box.height += answer.score * answer.box.height;
      sum.nose_mouth += answer.score * answer.nose_mouth;
      weight += answer.score;
      return true;
    });
    sum.box = {sum.box.x / weight, sum.box.y / weight, sum.box.width / weight, sum.box.height / weight};
    sum.nose_mouth /= weight;
    faces.push_back(sum);
  }
  return faces;
}

// Hairline to chin, px of the net's square.
cv::Rect2d calibrated(const Answer& face) {
  const cv::Rect2d& box = face.box;
  const double nose_mouth = std::clamp(face.nose_mouth / box.height, least_nose_mouth, most_nose_mouth);
  const double height = box.height * heights_a_box * std::pow(nose_mouth, nose_mouth_power);
  const double width = height * face_widths_a_height;
  const double chin_y = box.y + box.height * (1 + chin_below_box);
  return {box.x + box.width / 2 - width / 2, chin_y - height, width, height};
}

class BlazeFaceFinder final : public FaceFinder {
 public:
  explicit BlazeFaceFinder(const cv::dnn::Net& net) : net_(net) {}

  [[nodiscard]] std::string name() const override { return "BlazeFace"; }

  Result<FoundFaces> find(const cv::Mat& bgr) override {
    return checked_search(bgr, name(), [this](const cv::Mat& picture) { return find_in(picture); });
  }

 private:
  FoundFaces find_in(const cv::Mat& bgr) {
    const Letterbox letterbox(bgr.size());
    prepare(bgr, letterbox);
    // Rows by columns by channels, as the net was exported from TensorFlow; blobFromImage puts channels first.
    net_.setInput(cv::Mat(4, std::array{1, side_px, side_px, 3}.data(), CV_32F, input_.data));
    const std::vector<cv::String> wanted{grids[0].scores, grids[0].boxes, grids[1].scores, grids[1].boxes};
    net_.forward(answers_, wanted);
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < grids.size(); ++i)
      add_answers(grids[i], answers_[2 * i].ptr<float>(), answers_[2 * i + 1].ptr<float>(), answers);
    FoundFaces faces;
    for (const Answer& face : merged(std::move(answers)))
      faces.push_back({letterbox.in_picture(calibrated(face)), face.score});
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

  static void add_answers(const AnchorGrid& grid, const float* scores, const float* values,
                          std::vector<Answer>& answers) {
    const int count = grid.cells * grid.cells * grid.anchors;
    for (int i = 0; i < count; ++i) {
      const double score = 1 / (1 + std::exp(-static_cast<double>(scores[i])));
      if (!(score >= least_score)) continue;
      const int cell = i / grid.anchors;
      const int column = cell % grid.cells;
      const int row = cell / grid.cells;
      const double anchor_x = (column + 0.5) / grid.cells * side_px;
      const double anchor_y = (row + 0.5) / grid.cells * side_px;
      const float* const box = values + static_cast<std::ptrdiff_t>(i) * box_values;
      if (!(box[2] > 0) || !(box[3] > 0)) continue;
      const double nose_mouth =
          std::hypot(box[mouth_value] - box[nose_value], box[mouth_value + 1] - box[nose_value + 1]);
      answers.push_back(
          {score, {anchor_x + box[0] - box[2] / 2, anchor_y + box[1] - box[3] / 2, box[2], box[3]}, nose_mouth});
    }
  }

  cv::dnn::Net net_;
  cv::Mat square_, rgb_, input_;
  std::vector<cv::Mat> answers_;
};

}  // namespace

std::vector<fs::path> known_blaze_models() {
  return {data_folder() / "models" / model_name};
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
    return std::unique_ptr<FaceFinder>(std::make_unique<BlazeFaceFinder>(net));
  } catch (const cv::Exception& exception) {
    return Error{fmt::format("OpenCV can't load the face model {}: {}", found->string(), exception.what())};
  }
}

}  // namespace telehug
