// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "local_touch/local_touch_output.hpp"

namespace telehug {

struct TuioSettings {
  std::string host = "127.0.0.1";
  int port = 3333;  // the protocol's own
};

// Sends contacts as cursors by TUIO 1.1 (tuio.org/?specification): for each frame a bundle over UDP of `/tuio/2Dcur`
// source, alive, set and fseq. Places are parts of the screen's width and height, speeds the same a second, the
// acceleration of the speed a second squared. While nobody touches an empty bundle with fseq -1 goes out each second,
// so that a lost one leaves no cursor behind. UDP tells nobody whether someone listens.
class TuioSender final : public LocalTouchOutput {
 public:
  static constexpr Duration idle_interval = 1s;

  explicit TuioSender(TuioSettings settings);
  ~TuioSender() override;
  TuioSender(const TuioSender&) = delete;
  TuioSender& operator=(const TuioSender&) = delete;

  Status open(const ScreenSize& screen) override;
  Status send(const ContactStates& contacts, Timestamp time) override;
  void close() override;
  [[nodiscard]] std::string name() const override;

 private:
  struct Cursor {
    std::uint32_t contact = 0;
    float x = 0;
    float y = 0;
    float x_speed = 0;
    float y_speed = 0;
    float acceleration = 0;
    Timestamp time;
  };
  using Cursors = boost::container::static_vector<Cursor, max_contacts>;
  struct Address;  // liblo's

  [[nodiscard]] Cursor cursor_of(const ContactState& contact, Timestamp time) const;
  Status send_bundle(std::int32_t frame);

  TuioSettings settings_;
  std::string source_;
  std::unique_ptr<Address> address_;
  ScreenSize screen_;
  Cursors cursors_;
  std::int32_t frame_ = 0;
  std::optional<Timestamp> sent_;
};

}  // namespace telehug
