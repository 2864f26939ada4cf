// SPDX-License-Identifier: Apache-2.0
#include "bench/touch/mjpeg_figures.hpp"

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "doubles/jpeg_variants.hpp"
#include "pictures/jpeg_decoder.hpp"

namespace telehug {
namespace {

using Jpeg = std::vector<std::uint8_t>;

// As most webcams sample colours; the quality gives frames as large as theirs.
constexpr JpegVariant webcam_jpeg{"4:2:2", 2, 1};
constexpr int webcam_quality = 85;

// Reads the codes of a whole picture as libjpeg does, without even a place for the coefficients (what
// jpeg_read_coefficients() takes for its 8 MB of them at 1920x1080 is no lower bound). Only the last blocks become
// pixels: libjpeg skips no rows to the end.
class EntropyDecoder {
 public:
  EntropyDecoder() {
    codec_.err = jpeg_std_error(&errors_);  // ends the program: the pictures are good
    jpeg_create_decompress(&codec_);
  }
  ~EntropyDecoder() { jpeg_destroy_decompress(&codec_); }
  EntropyDecoder(const EntropyDecoder&) = delete;
  EntropyDecoder& operator=(const EntropyDecoder&) = delete;

  void decode(const Jpeg& jpeg) {
    jpeg_mem_src(&codec_, jpeg.data(), jpeg.size());
    jpeg_read_header(&codec_, TRUE);
    codec_.out_color_space = JCS_GRAYSCALE;
    jpeg_start_decompress(&codec_);
    row_.resize(codec_.output_width);
    JSAMPROW row = row_.data();
    jpeg_skip_scanlines(&codec_, codec_.output_height - DCTSIZE);
    jpeg_read_scanlines(&codec_, &row, 1);
    jpeg_abort_decompress(&codec_);
  }

 private:
  jpeg_decompress_struct codec_{};
  jpeg_error_mgr errors_{};
  std::vector<JSAMPLE> row_;
};

// Eight bytes at a time, as fast as memory delivers them.
std::uint64_t one_pass(const cv::Mat& bgr) {
  std::uint64_t sum = 0;
  for (int row = 0; row < bgr.rows; ++row) {
    const std::uint8_t* const bytes = bgr.ptr<std::uint8_t>(row);
    for (std::size_t i = 0; i + sizeof sum <= static_cast<std::size_t>(bgr.cols) * 3; i += sizeof sum) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + i, sizeof word);
      sum ^= word;
    }
  }
  return sum;
}

void must(const Status& decoded) {
  if (!decoded) throw std::runtime_error(decoded.error().message);
}

}  // namespace

Figures measure_mjpeg(FingerDetector& detector, RowRange rows, const TouchedRig& rig, const std::string& suffix) {
  std::vector<Jpeg> jpegs;
  for (const cv::Mat& picture : rig.pictures)
    jpegs.push_back(jpeg_of(picture, webcam_jpeg, webcam_quality));

  const std::string name = "touch.mjpeg" + suffix;
  Figures figures{{name, "ms"},
                  {name + ".bound", "ms"},
                  {name + ".decode", "ms"},
                  {name + ".decode_whole", "ms"},
                  {name + ".decoder_allocations", "allocations"},
                  {name + ".touches", "fingers"},
                  {name + ".rows_needed", "rows"},
                  {name + ".bytes", "kB"}};
  for (Figure& figure : figures)
    figure.samples.reserve(bench_rounds);
  JpegDecoder decoder;
  JpegDecoder whole_decoder;
  EntropyDecoder entropy_decoder;
  cv::Mat bgr;
  cv::Mat whole;
  std::uint64_t sum = 0;
  for (int i = 0; i < bench_warm_up_rounds + bench_rounds; ++i) {
    const Jpeg& jpeg = jpegs[static_cast<std::size_t>(i) % jpegs.size()];
    Stopwatch watch;
    must(whole_decoder.decode(jpeg, whole));
    const double whole_ms = watch.lap_ms();
    entropy_decoder.decode(jpeg);
    sum += one_pass(whole.rowRange(rows.first, rows.end));
    const double bound_ms = watch.lap_ms();
    const auto allocated = allocation_count();
    watch.lap_ms();
    must(decoder.decode(jpeg, bgr, rows));
    const double decode_ms = watch.lap_ms();
    const auto allocations = static_cast<double>(allocation_count() - allocated);
    watch.lap_ms();
    const Fingers& fingers = detector.detect(bgr);
    const TouchedPoints touched = screen_points(fingers, rig.model, rig.screen, rig.image);
    const double frame_ms = decode_ms + watch.lap_ms();
    if (i < bench_warm_up_rounds) continue;
    const std::vector<double> values{frame_ms,
                                     bound_ms,
                                     decode_ms,
                                     whole_ms,
                                     allocations,
                                     static_cast<double>(touched.fingers.size()),
                                     static_cast<double>(rows.count()),
                                     static_cast<double>(jpeg.size()) / 1000};
    for (std::size_t f = 0; f < figures.size(); ++f)
      figures[f].samples.push_back(values[f]);
  }
  if (sum == 0) throw std::runtime_error("the pictures are black");
  figures.push_back({name + ".ratio", "x", {figures[0].percentile(0.5) / figures[1].percentile(0.5)}});
  return figures;
}

}  // namespace telehug
