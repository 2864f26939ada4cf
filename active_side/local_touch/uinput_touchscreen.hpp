// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "local_touch/local_touch_output.hpp"
#include "local_touch/uinput_calls.hpp"

namespace telehug {

// The monitor as a touchscreen of this PC: a virtual multitouch device of the kernel, protocol B (the kernel's
// Documentation/input/multi-touch-protocol.rst), with as many slots as there are contacts. Its axes are hundredths of a
// millimetre of the visible screen, so that programs know the distances; README.md says how it gets to the right
// monitor.
class UinputTouchscreen final : public LocalTouchOutput {
 public:
  static constexpr const char* device_name = "telehug touchscreen";
  static constexpr const char* device_phys = "telehug/touchscreen0";
  static constexpr int units_per_mm = 100;

  // `calls` outlive it.
  explicit UinputTouchscreen(UinputCalls& calls = kernel_uinput_calls()) : calls_(calls) {}

  Status open(const ScreenSize& screen) override;
  Status send(const ContactStates& contacts, Timestamp time) override;
  void close() override;
  [[nodiscard]] std::string name() const override;

 private:
  struct Slot {
    std::uint32_t contact = 0;
    bool used = false;
    std::uint64_t order = 0;  // the oldest contact is the pointer of programs that know one finger only
    int x = 0;
    int y = 0;
  };

  void lift_all_but(const ContactStates& contacts);
  void place(const ContactState& contact);
  void tell_pointer();
  void add(std::uint16_t type, std::uint16_t code, int value);

  UinputCalls& calls_;
  std::unique_ptr<UinputDevice> device_;
  int max_x_ = 0;
  int max_y_ = 0;
  std::array<Slot, max_contacts> slots_;
  std::uint64_t touches_ = 0;
  bool pointing_ = false;
  std::vector<input_event> events_;
};

}  // namespace telehug
