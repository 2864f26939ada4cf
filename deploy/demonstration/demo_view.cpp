// SPDX-License-Identifier: Apache-2.0
#include "demo_view.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "jacket/body_picture.hpp"

namespace telehug {
namespace {

constexpr int columns = 5;
constexpr int most_rows = 7;
constexpr int grid_width = 5 * columns + 3;
constexpr const char* highlighted = "\x1b[30;43m";
constexpr const char* plain = "\x1b[0m";

constexpr std::array face{"        .-------.        ", "        | o   o |        ", "        |   v   |        ",
                          "         '-...-'         "};
constexpr int first_grid_line = static_cast<int>(face.size());

// One line of the child's picture as the toucher sees it: the face, and the grid below the chin.
std::string picture_line(int line, int rows, int touched) {
  const std::string gap(grid_width - 5 * columns, ' ');
  if (line < first_grid_line) return face.at(static_cast<std::size_t>(line)) + gap;
  const int row = line - first_grid_line;
  if (row >= rows) return std::string(grid_width, ' ');
  std::string text;
  for (int column = 0; column < columns; ++column) {
    const int box = row * columns + column + 1;
    const std::string cell = fmt::format("[{:>2}]", box);
    text += box == touched ? highlighted + cell + plain : cell;
    text += ' ';
  }
  return text + gap;
}

}  // namespace

DemoView::DemoView(const JacketProfile& profile, bool in_place) : profile_(profile), in_place_(in_place) {
  if (in_place_) draw();
}

DemoView::~DemoView() {
  if (in_place_) fmt::print("\n");
}

void DemoView::show(const nlohmann::json& event) {
  const std::string kind = event.value("event", "");
  const bool active = event.value("side", "") == "active";
  if (kind == "touch" && active) {
    const std::string phase = event.at("phase");
    const int box = event.at("box");
    rows_ = std::min(event.at("rows").get<int>(), most_rows);
    const bool news = phase != "move" || box != touched_box_;
    touched_box_ = phase == "up" ? 0 : box;
    last_touch_ = fmt::format("contact {} {:<4} box {:>2} at {:.0f}, {:.0f} mm", event.at("contact").get<int>(), phase,
                              box, event.at("x_mm").get<double>(), event.at("y_mm").get<double>());
    if (const std::string gesture = event.value("gesture", "none"); gesture != "none") last_touch_ += ", " + gesture;
    if (news) say("touched  " + last_touch_);
  } else if (kind == "felt" && !active) {
    last_felt_ = fmt::format("contact {} box {:>2} {} at motors {}", event.at("contact").get<int>(),
                             event.at("box").get<int>(), event.at("outcome").get<std::string>(),
                             fmt::join(event.at("actuators").get<std::vector<int>>(), ", "));
    if (event.at("phase") != "up") say("felt     " + last_felt_);
  } else if (kind == "running") {
    running_ = event.at("actuators").get<std::vector<std::uint8_t>>();
    say(running_.empty() ? "motors   all off" : fmt::format("motors   {} run", fmt::join(running_, ", ")));
  } else {
    return;
  }
  if (in_place_) draw();
}

void DemoView::say(const std::string& line) {
  if (in_place_) return;
  fmt::print("{}\n", line);
  (void)std::fflush(stdout);
}

void DemoView::draw() {
  const auto body = body_picture(profile_, running_);
  if (drawn_) fmt::print("\x1b[{}F", body.size() + 3);
  drawn_ = true;
  fmt::print("\x1b[2K   the child's picture          the jacket\n");
  for (std::size_t i = 0; i < body.size(); ++i)
    fmt::print("\x1b[2K   {}{}\n", picture_line(static_cast<int>(i), rows_, touched_box_), body[i]);
  fmt::print("\x1b[2K   touched: {}\n\x1b[2K   felt:    {}\n", last_touch_, last_felt_);
  (void)std::fflush(stdout);
}

}  // namespace telehug
