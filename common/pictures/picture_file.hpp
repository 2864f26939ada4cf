// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"
#include "common/row_range.hpp"
#include "pictures/jpeg_decoder.hpp"
#include "pictures/png_note.hpp"

namespace telehug {

// Reads JPEG and PNG files one after the other with buffers that are kept. Not for use by two threads at a time.
class PictureReader {
 public:
  // As read_picture(), into `bgr`, whose memory is kept if its size fits. After an error it holds no picture. Of a JPEG
  // only `rows` need be filled, see JpegDecoder::decode().
  Status read(const std::filesystem::path& path, cv::Mat& bgr, RowRange rows = {});

 private:
  JpegDecoder jpeg_;
  std::vector<std::uint8_t> bytes_;
};

// Reads a JPEG or PNG file (its content decides, not its name) as CV_8UC3 BGR; transparent parts of a PNG become black.
// Files of more than 64 MB and pictures of more than 8192 pixels a side are refused.
Result<cv::Mat> read_picture(const std::filesystem::path& path);

// Writes CV_8UC3 BGR or CV_8UC1 grey as PNG. The file appears under its name when it is complete.
Status write_png(const std::filesystem::path& path, const cv::Mat& picture,
                 const std::optional<PngNote>& note = std::nullopt);

// The text that write_png() put into the file under this keyword; nothing if there is none.
Result<std::optional<std::string>> read_png_note(const std::filesystem::path& path, std::string_view keyword);

// Writes CV_8UC3 BGR as JPEG (4:2:0) of `quality` 1..100. The file appears under its name when it is complete.
Status write_jpeg(const std::filesystem::path& path, const cv::Mat& picture, int quality = 92);

}  // namespace telehug
