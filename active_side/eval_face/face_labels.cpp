// SPDX-License-Identifier: Apache-2.0
#include "eval_face/face_labels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <system_error>

#include "capture/csv_table.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

std::optional<cv::Rect2d> read_box(CsvTable& table, std::size_t row) {
  const auto x = table.number(row, 1);
  const auto y = table.number(row, 2);
  const auto width = table.number(row, 3);
  const auto height = table.number(row, 4);
  if (!x || !y || !width || !height) {
    return std::nullopt;
  }
  return cv::Rect2d(*x, *y, *width, *height);
}

std::optional<FaceRole> role_of(std::string_view name) {
  if (name == "remote") {
    return FaceRole::remote;
  }
  if (name == "self") {
    return FaceRole::self;
  }
  if (name == "other") {
    return FaceRole::other;
  }
  return std::nullopt;
}

void read_faces(const fs::path& path, FaceLabels& labels, std::vector<std::string>& faults) {
  CsvTable table(path, {"image", "face_x", "face_y", "face_w", "face_h", "role"}, faults);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    LabelledPicture& picture = labels[std::string(table.text(row, 0))];
    if (table.text(row, 5) == "none") {
      continue;
    }
    const auto role = role_of(table.text(row, 5));
    const auto box = read_box(table, row);
    if (!role) {
      table.add_fault(row, fmt::format("the role '{}' is none of remote, self, other, none", table.text(row, 5)));
    } else if (box && (box->width <= 0 || box->height <= 0)) {
      table.add_fault(row, "the face has no size");
    } else if (box) {
      picture.faces.push_back({*box, *role});
    }
  }
}

void read_views(const fs::path& path, FaceLabels& labels, std::vector<std::string>& faults) {
  CsvTable table(path, {"image", "view_x", "view_y", "view_w", "view_h", "role"}, faults);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, 5) != "remote") {
      continue;
    }
    if (const auto box = read_box(table, row)) {
      labels[std::string(table.text(row, 0))].remote_view = *box;
    }
  }
}

}  // namespace

Result<std::optional<FaceLabels>> read_face_labels(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder / "labels.csv", ignored)) {
    return std::optional<FaceLabels>();
  }
  FaceLabels labels;
  std::vector<std::string> faults;
  read_faces(folder / "labels.csv", labels, faults);
  if (fs::exists(folder / "views.csv", ignored)) {
    read_views(folder / "views.csv", labels, faults);
  }
  for (const auto& [name, picture] : labels) {
    if (!fs::exists(folder / name, ignored)) {
      faults.push_back(fmt::format("{}: there is no such picture, but a label for it", (folder / name).string()));
    }
  }
  if (!faults.empty()) {
    return Error{fmt::format("{}", fmt::join(faults, "\n"))};
  }
  return std::optional<FaceLabels>(std::move(labels));
}

}  // namespace telehug
