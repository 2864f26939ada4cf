// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_damage.hpp"

namespace telehug {

X11Damage::X11Damage(const X11Connection& connection, xcb_window_t window) : connection_(connection) {
  const auto* extension = connection.extension(xcb_damage_id);
  first_event_ = extension != nullptr ? extension->first_event : 0;
  damage_ = xcb_generate_id(connection.get());
  parts_ = xcb_generate_id(connection.get());
  // With NON_EMPTY the events would tell nothing of the place.
  xcb_damage_create(connection.get(), damage_, window, XCB_DAMAGE_REPORT_LEVEL_BOUNDING_BOX);
  xcb_xfixes_create_region(connection.get(), parts_, 0, nullptr);
}

X11Damage::~X11Damage() {
  xcb_damage_destroy(connection_.get(), damage_);
  xcb_xfixes_destroy_region(connection_.get(), parts_);
}

bool X11Damage::note(const xcb_generic_event_t& event) {
  if (!is_x11_event(event, first_event_ + XCB_DAMAGE_NOTIFY)) {
    return false;
  }
  const auto& notify = reinterpret_cast<const xcb_damage_notify_event_t&>(event);
  if (notify.damage != damage_) {
    return false;
  }
  noted_px_ |= cv::Rect(notify.area.x, notify.area.y, notify.area.width, notify.area.height);
  return true;
}

std::vector<cv::Rect> X11Damage::take(const cv::Rect& watched_px) {
  std::vector<cv::Rect> drawn;
  if (noted_px_.empty()) {
    return drawn;
  }
  const bool touched = !(noted_px_ & watched_px).empty();
  noted_px_ = {};
  // The events' rectangle spans all that was drawn in; the region has its parts one by one. Until it is taken no more
  // events come.
  xcb_damage_subtract(connection_.get(), damage_, XCB_NONE, parts_);
  if (!touched) {
    xcb_flush(connection_.get());
    return drawn;
  }
  const auto asked = xcb_xfixes_fetch_region(connection_.get(), parts_);
  const XcbOwned<xcb_xfixes_fetch_region_reply_t> reply(
      xcb_xfixes_fetch_region_reply(connection_.get(), asked, nullptr));
  if (!reply) {
    return drawn;
  }
  const xcb_rectangle_t* part = xcb_xfixes_fetch_region_rectangles(reply.get());
  for (int left = xcb_xfixes_fetch_region_rectangles_length(reply.get()); left > 0; --left, ++part) {
    drawn.emplace_back(part->x, part->y, part->width, part->height);
  }
  return drawn;
}

}  // namespace telehug
