// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "common/clock.hpp"
#include "face/face_finder.hpp"
#include "face/inner_change.hpp"
#include "face/remote_face_rules.hpp"

namespace telehug {

struct FollowedFace {
  std::uint32_t person = 0;  // another number: not a motion of the last one
  cv::Rect2d box;            // hairline to chin, px of the picture, as last seen
  Timestamp seen;            // when it was there; before the last look: it is held
};

// Why nobody is followed.
enum class NobodyFollowed {
  no_face,   // none is found
  not_sure,  // one is found, but not surely or not for long enough yet
  still,     // one is found that never moves: a picture of somebody
  refused,   // one is found that is too small, in a corner or outside of what is pinned
};

// Follows the remote person through looks at the screen. Whom it takes first: the largest face that the rules let it
// take. It keeps that one until it has been unseen for the hold time or a larger one takes over. A face that appears
// after the followed one has vanished is that one, moved, and need not be waited for.
class RemoteFaceFollower {
 public:
  // `live`: does the screen show what happens now (ScreenGrabber::is_live)?
  RemoteFaceFollower(const RemoteFaceRules& rules, bool live) : rules_(rules), live_(live) {}

  // The picture of a look and all faces found in it. Times must rise.
  const std::optional<FollowedFace>& look(Timestamp time, const cv::Mat& picture, const FoundFaces& faces);

  // The screen shows what it showed at the last look.
  const std::optional<FollowedFace>& unchanged(Timestamp time);

  // There is no picture.
  const std::optional<FollowedFace>& blind(Timestamp time);

  // What is looked at is another part of the screen now: nothing seen before is of use. A pin ends.
  void start_anew();

  // The screen is not looked at for a while: who is there afterwards must show again that it is somebody. A pin stays.
  void rest();

  // By hand. The next face to the right that may be taken is followed until it is lost, whatever its size; false if
  // there is no other.
  bool next();
  // No other face takes over any more, and when this one is lost only one at its place is taken; false if there is
  // none.
  bool pin();
  void unpin() { pinned_.reset(); }

  [[nodiscard]] bool pinned() const { return pinned_.has_value(); }
  [[nodiscard]] NobodyFollowed why_nobody() const { return why_nobody_; }
  // How many faces next() could choose.
  [[nodiscard]] int others() const;

 private:
  struct Candidate {
    cv::Rect2d box;
    double score = 0;
    Timestamp appeared;    // seen for the first time, or again after half a second and more
    Timestamp seen_since;  // in every look from then ...
    Timestamp last_seen;   // ... to then
    unsigned sure = 0;     // bit k: surely found k looks ago
    InnerChange inside;
    std::optional<Timestamp> changed, changed_before;  // when the picture in it last did, and the time before
    std::optional<Timestamp> larger_since;             // than the followed one, by the takeover ratio
    std::uint32_t person = 0;                          // 0: never followed
    std::uint32_t beside = 0;                          // the followed person in whose company it was seen last
    bool allowed = false;                              // by its size and place
  };

  void match(Timestamp before, const cv::Mat& picture, const FoundFaces& faces);
  void update(Candidate& candidate, Timestamp before, const cv::Mat& picture, const FoundFace& face);
  [[nodiscard]] bool seen_now(const Candidate& candidate) const { return candidate.last_seen == now_; }
  [[nodiscard]] bool allowed(const cv::Rect2d& box) const;
  [[nodiscard]] bool sure_enough(const Candidate& candidate) const;
  [[nodiscard]] bool changes(const Candidate& candidate) const;
  [[nodiscard]] bool ready(const Candidate& candidate) const;
  // For a choice by hand: whoever sits still now has moved once.
  [[nodiscard]] bool choosable(const Candidate& candidate) const;
  [[nodiscard]] Candidate* followed();
  [[nodiscard]] const Candidate* followed() const;
  Candidate* successor();
  Candidate* largest_ready();
  void take_over();
  void follow(Candidate& candidate);
  const std::optional<FollowedFace>& decide();
  [[nodiscard]] NobodyFollowed reason() const;

  RemoteFaceRules rules_;
  bool live_;
  Timestamp now_;  // of the last look
  cv::Size picture_;
  std::vector<Candidate> candidates_;
  std::optional<FollowedFace> followed_;
  bool by_hand_ = false;
  std::optional<cv::Rect2d> pinned_;  // where the middle of a face must be
  std::uint32_t last_person_ = 0;
  NobodyFollowed why_nobody_ = NobodyFollowed::no_face;
};

}  // namespace telehug
