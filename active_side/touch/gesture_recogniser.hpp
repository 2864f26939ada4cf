// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <optional>

#include "common/clock.hpp"
#include "common/messages.hpp"
#include "common/units.hpp"
#include "touch/contact_state.hpp"

namespace telehug {

// Thresholds of others: libinput takes 180 ms and 1.3 mm for a tap on a touchpad (evdev-mt-touchpad-tap.c); Android 400
// ms for a long press (500 ms before Android 11), 300 ms between two taps and 8 dp = 1.3 mm (ViewConfiguration);
// Windows 500 ms between two clicks (GetDoubleClickTime). Their devices measure to a tenth of a millimetre, a webcam
// doesn't.
struct GestureOptions {
  // A contact that rests for so long is held; one that is lifted before was tapped, so that there is no third way
  // between. Android's long press.
  Duration hold_after = 400ms;
  // A contact that got so far from where it began strokes. A resting finger's tip is measured within 4.4 mm (p95, with
  // two calibration touches): farther apart than twice that, it has moved.
  double stroke_from_mm = 10;
  // A tap so soon after another one is a pat (from that one's last sight to this one's down). The more patient of the
  // two above: a pat is slower than a double click, and the hand is off the screen, where nothing guides it.
  Duration pat_within = 500ms;
  // And so near to it. A hand that pats aims no better than its own width.
  double pat_within_mm = 80;
  // A hug is held on both sides of the body: outside of this middle part of the grid's width. The middle one of the
  // thesis' five columns.
  double middle_part = 0.2;
};

// Says of every contact what it is so far and, when it ends, what it was. None of them is announced before it is
// certain, but a hold may still become a stroke or a hug; a stroke, and a hug, stays one until its contact ends. So a
// contact ends as at most one gesture:
//   tap     down and up again at one place before hold_after
//   pat     a tap soon after and near to another one
//   hold    resting at one place for hold_after
//   stroke  moved by stroke_from_mm
//   hug     at least two contacts hold at the same time, on both sides of the body
// Allocates nothing.
class GestureRecogniser {
 public:
  explicit GestureRecogniser(const GestureOptions& options = {}) : options_(options) {}

  // The given contacts with their gestures. `contacts`: all of one frame, ids unique, each down once, then move, then
  // up once; one that breaks this is taken as it comes. `grid`: where the remote person's body is on the screen;
  // without it nobody is hugged. Times that jump recognise a hold too early or too late at worst. Valid until the next
  // call.
  const ContactStates& update(const ContactStates& contacts, const std::optional<ScreenRect>& grid);

 private:
  struct Track {
    std::uint32_t id = 0;
    ScreenPoint began;
    Timestamp began_at;
    Timestamp seen_at;  // when the finger was last seen
    Gesture gesture = Gesture::none;
  };
  struct Tap {
    ScreenPoint at;
    Timestamp ended;
    bool known = false;
  };

  Track& track_of(const ContactState& contact);
  [[nodiscard]] Gesture tap_or_pat(const Track& track, const ScreenPoint& at);
  void hug(const ScreenRect& grid);

  GestureOptions options_;
  boost::container::static_vector<Track, max_contacts> tracks_;
  std::array<Tap, max_contacts> taps_;  // the latest ones
  std::size_t next_tap_ = 0;
  ContactStates states_;
};

}  // namespace telehug
