// SPDX-License-Identifier: Apache-2.0
#include "local_touch/uinput_touchscreen.hpp"

#include <fmt/core.h>
#include <libevdev/libevdev.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

namespace telehug {
namespace {

using Description = std::unique_ptr<libevdev, decltype(&libevdev_free)>;

constexpr int max_tracking_id = 65535;
// Ours alone, so that rules and settings can name it: udev's ID_VENDOR_ID and ID_MODEL_ID.
constexpr int vendor = 0x7468;
constexpr int product = 0x0001;

void enable_axis(libevdev& description, unsigned int code, int maximum, int resolution) {
  input_absinfo axis{};
  axis.maximum = maximum;
  axis.resolution = resolution;
  libevdev_enable_event_code(&description, EV_ABS, code, &axis);
}

Description describe(int max_x, int max_y) {
  Description description(libevdev_new(), &libevdev_free);
  libevdev_set_name(description.get(), UinputTouchscreen::device_name);
  libevdev_set_id_bustype(description.get(), BUS_VIRTUAL);
  libevdev_set_id_vendor(description.get(), vendor);
  libevdev_set_id_product(description.get(), product);
  libevdev_set_id_version(description.get(), 1);
  libevdev_enable_property(description.get(), INPUT_PROP_DIRECT);
  libevdev_enable_event_code(description.get(), EV_KEY, BTN_TOUCH, nullptr);
  constexpr int per_mm = UinputTouchscreen::units_per_mm;
  enable_axis(*description, ABS_X, max_x, per_mm);
  enable_axis(*description, ABS_Y, max_y, per_mm);
  enable_axis(*description, ABS_MT_SLOT, static_cast<int>(max_contacts) - 1, 0);
  enable_axis(*description, ABS_MT_TRACKING_ID, max_tracking_id, 0);
  enable_axis(*description, ABS_MT_POSITION_X, max_x, per_mm);
  enable_axis(*description, ABS_MT_POSITION_Y, max_y, per_mm);
  return description;
}

Error failure(int code) {
  switch (-code) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return {"the touchscreen can't be made: there is no /dev/uinput; load it with `sudo modprobe uinput`"};
    case EACCES:
    case EPERM:
      return {
          "the touchscreen can't be made: this user must not use /dev/uinput; install "
          "deploy/udev/70-telehug-uinput.rules (see active_side/local_touch/README.md) and log in again"};
    default:
      return {fmt::format("the touchscreen can't be used: {}", std::strerror(-code))};
  }
}

int axis_value(double at_mm, int maximum) {
  const double value = std::isfinite(at_mm) ? at_mm * UinputTouchscreen::units_per_mm : 0;
  return static_cast<int>(std::lround(std::clamp(value, 0.0, static_cast<double>(maximum))));
}

}  // namespace

Status UinputTouchscreen::open(const ScreenSize& screen) {
  close();
  max_x_ = static_cast<int>(std::lround(screen.width_mm * units_per_mm));
  max_y_ = static_cast<int>(std::lround(screen.height_mm * units_per_mm));
  const Description description = describe(max_x_, max_y_);
  if (const int code = calls_.create(*description, device_phys, device_); code < 0) return failure(code);
  slots_ = {};
  pointing_ = false;
  return Done{};
}

void UinputTouchscreen::close() {
  device_.reset();  // the kernel lifts what is still down
}

std::string UinputTouchscreen::name() const {
  const std::string node = device_ ? device_->node() : "";
  return node.empty() ? "touchscreen" : "touchscreen " + node;
}

Status UinputTouchscreen::send(const ContactStates& contacts, Timestamp /*time*/) {
  events_.clear();
  lift_all_but(contacts);
  for (const ContactState& contact : contacts) {
    if (contact.phase != Phase::up) place(contact);
  }
  tell_pointer();
  if (events_.empty()) return Done{};
  add(EV_SYN, SYN_REPORT, 0);
  if (const int code = device_->write(events_); code < 0) return failure(code);
  return Done{};
}

void UinputTouchscreen::lift_all_but(const ContactStates& contacts) {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto stays = [&](const ContactState& contact) {
      return contact.id == slots_[i].contact && contact.phase != Phase::up;
    };
    if (!slots_[i].used || std::ranges::any_of(contacts, stays)) continue;
    slots_[i].used = false;
    add(EV_ABS, ABS_MT_SLOT, static_cast<int>(i));
    add(EV_ABS, ABS_MT_TRACKING_ID, -1);
  }
}

void UinputTouchscreen::place(const ContactState& contact) {
  auto slot =
      std::ranges::find_if(slots_, [&](const Slot& known) { return known.used && known.contact == contact.id; });
  const bool known = slot != slots_.end();
  if (!known) slot = std::ranges::find(slots_, false, &Slot::used);
  if (slot == slots_.end()) return;
  const int x = axis_value(contact.screen.x_mm, max_x_);
  const int y = axis_value(contact.screen.y_mm, max_y_);
  if (known && slot->x == x && slot->y == y) return;
  add(EV_ABS, ABS_MT_SLOT, static_cast<int>(slot - slots_.begin()));
  if (!known) {
    add(EV_ABS, ABS_MT_TRACKING_ID, static_cast<int>(touches_ % max_tracking_id));
    *slot = {contact.id, true, touches_++, 0, 0};
  }
  slot->x = x;
  slot->y = y;
  add(EV_ABS, ABS_MT_POSITION_X, x);
  add(EV_ABS, ABS_MT_POSITION_Y, y);
}

void UinputTouchscreen::tell_pointer() {
  if (events_.empty()) return;
  const auto older = [](const Slot& a, const Slot& b) {
    return a.used != b.used ? a.used : a.order < b.order;  // unused ones last
  };
  const Slot& oldest = *std::ranges::min_element(slots_, older);
  if (oldest.used != pointing_) add(EV_KEY, BTN_TOUCH, oldest.used ? 1 : 0);
  pointing_ = oldest.used;
  if (!oldest.used) return;
  add(EV_ABS, ABS_X, oldest.x);
  add(EV_ABS, ABS_Y, oldest.y);
}

void UinputTouchscreen::add(std::uint16_t type, std::uint16_t code, int value) {
  input_event& event = events_.emplace_back();  // the kernel sets the time
  event.type = type;
  event.code = code;
  event.value = value;
}

}  // namespace telehug
