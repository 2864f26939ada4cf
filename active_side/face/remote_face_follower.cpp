// SPDX-License-Identifier: Apache-2.0
#include "face/remote_face_follower.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace telehug {
namespace {

constexpr unsigned three_looks = 0b111;
constexpr Duration away = 500ms;  // a face unseen for longer has appeared anew
// Around a pinned face, in its heights: as far as the grid reaches to the sides, and one up and down.
constexpr double pinned_width_fh = 2.5;
constexpr double pinned_height_fh = 2;

cv::Point2d middle(const cv::Rect2d& box) {
  return {box.x + box.width / 2, box.y + box.height / 2};
}

bool near_an_end(double position, double length, double share) {
  return std::min(position, length - position) < share * length;
}

// In heights of the first.
double distance_fh(const cv::Rect2d& a, const cv::Rect2d& b) {
  const cv::Point2d off = middle(b) - middle(a);
  return std::hypot(off.x, off.y) / a.height;
}

bool by_height(const cv::Rect2d& a, const cv::Rect2d& b) {
  return a.height < b.height;
}

}  // namespace

const std::optional<FollowedFace>& RemoteFaceFollower::look(Timestamp time, const cv::Mat& picture,
                                                            const FoundFaces& faces) {
  const Timestamp before = now_;
  now_ = time;
  picture_ = picture.size();
  // Before faces are matched: where somebody was seen too long ago, whoever is found there now may be another.
  std::erase_if(candidates_, [&](const Candidate& candidate) { return now_ - candidate.last_seen > rules_.hold; });
  match(before, picture, faces);
  return decide();
}

const std::optional<FollowedFace>& RemoteFaceFollower::unchanged(Timestamp time) {
  for (Candidate& candidate : candidates_)
    if (seen_now(candidate)) candidate.last_seen = time;
  now_ = time;
  return decide();
}

const std::optional<FollowedFace>& RemoteFaceFollower::blind(Timestamp time) {
  now_ = time;
  return decide();
}

void RemoteFaceFollower::start_anew() {
  candidates_.clear();
  followed_.reset();
  pinned_.reset();
  by_hand_ = false;
}

void RemoteFaceFollower::rest() {
  candidates_.clear();
  followed_.reset();
  by_hand_ = false;
}

// Nearest pairs first.
void RemoteFaceFollower::match(Timestamp before, const cv::Mat& picture, const FoundFaces& faces) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // distance, candidate, face
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    candidates_[c].sure = (candidates_[c].sure << 1U) & three_looks;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const double distance = distance_fh(candidates_[c].box, faces[f].box);
      const double ratio = faces[f].box.height / candidates_[c].box.height;
      if (distance <= rules_.same_place_fh && std::max(ratio, 1 / ratio) <= 1 + rules_.same_height)
        pairs.emplace_back(distance, c, f);
    }
  }
  std::ranges::sort(pairs);
  std::vector<bool> found_again(candidates_.size());
  std::vector<bool> known(faces.size());
  for (const auto& [distance, c, f] : pairs) {
    if (found_again[c] || known[f] || faces[f].score < rules_.least_score) continue;
    found_again[c] = known[f] = true;
    update(candidates_[c], before, picture, faces[f]);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (known[f] || faces[f].score < rules_.least_score || !(faces[f].box.height > 0)) continue;
    Candidate& fresh = candidates_.emplace_back();
    fresh.appeared = fresh.seen_since = fresh.last_seen = now_;
    update(fresh, before, picture, faces[f]);
  }
}

void RemoteFaceFollower::update(Candidate& candidate, Timestamp before, const cv::Mat& picture, const FoundFace& face) {
  if (candidate.last_seen < before) candidate.seen_since = now_;
  if (now_ - candidate.last_seen > away) candidate.appeared = now_;
  candidate.last_seen = now_;
  candidate.box = face.box;
  candidate.score = face.score;
  if (face.score >= rules_.sure_score) candidate.sure |= 1U;
  candidate.allowed = allowed(face.box);
  if (live_ && candidate.inside.look(picture, face.box)) {
    candidate.changed_before = candidate.changed;
    candidate.changed = now_;
  }
}

bool RemoteFaceFollower::allowed(const cv::Rect2d& box) const {
  const cv::Point2d at = middle(box);
  if (pinned_ && !pinned_->contains(at)) return false;
  return box.height >= rules_.min_height_share * picture_.height &&
         !(near_an_end(at.x, picture_.width, rules_.corner_share) &&
           near_an_end(at.y, picture_.height, rules_.corner_share));
}

bool RemoteFaceFollower::sure_enough(const Candidate& candidate) const {
  if (!live_) return candidate.score >= rules_.still_score;
  return std::popcount(candidate.sure) >= 2 || now_ - candidate.seen_since >= rules_.unsure_for;
}

bool RemoteFaceFollower::changes(const Candidate& candidate) const {
  return !live_ || (candidate.changed_before && now_ - *candidate.changed_before <= rules_.changes_within);
}

bool RemoteFaceFollower::ready(const Candidate& candidate) const {
  return seen_now(candidate) && candidate.allowed && sure_enough(candidate) && changes(candidate);
}

bool RemoteFaceFollower::choosable(const Candidate& candidate) const {
  return seen_now(candidate) && candidate.allowed && sure_enough(candidate) && (!live_ || candidate.changed_before);
}

RemoteFaceFollower::Candidate* RemoteFaceFollower::followed() {
  if (!followed_) return nullptr;
  const auto found = std::ranges::find(candidates_, followed_->person, &Candidate::person);
  return found == candidates_.end() ? nullptr : &*found;
}

const RemoteFaceFollower::Candidate* RemoteFaceFollower::followed() const {
  if (!followed_) return nullptr;
  const auto found = std::ranges::find(candidates_, followed_->person, &Candidate::person);
  return found == candidates_.end() ? nullptr : &*found;
}

RemoteFaceFollower::Candidate* RemoteFaceFollower::largest_ready() {
  Candidate* largest = nullptr;
  for (Candidate& candidate : candidates_) {
    if (ready(candidate) && (largest == nullptr || by_height(largest->box, candidate.box))) largest = &candidate;
  }
  return largest;
}

// What has appeared since the followed one was seen last, and was never seen beside it, is the same person elsewhere.
RemoteFaceFollower::Candidate* RemoteFaceFollower::successor() {
  Candidate* largest = nullptr;
  for (Candidate& candidate : candidates_) {
    if (!ready(candidate) || candidate.appeared <= followed_->seen || candidate.beside == followed_->person) continue;
    if (largest == nullptr || by_height(largest->box, candidate.box)) largest = &candidate;
  }
  return largest;
}

// A face that has been larger for long enough.
void RemoteFaceFollower::take_over() {
  for (Candidate& candidate : candidates_) {
    const bool larger = seen_now(candidate) && candidate.allowed &&
                        candidate.box.height >= rules_.takeover_ratio * followed_->box.height;
    if (!larger) {
      candidate.larger_since.reset();
    } else if (!candidate.larger_since) {
      candidate.larger_since = now_;
    } else if (now_ - *candidate.larger_since >= rules_.takeover_after && ready(candidate)) {
      follow(candidate);
      return;
    }
  }
}

void RemoteFaceFollower::follow(Candidate& candidate) {
  if (candidate.person == 0) candidate.person = ++last_person_;
  followed_ = FollowedFace{candidate.person, candidate.box, candidate.last_seen};
  by_hand_ = false;
  for (Candidate& other : candidates_)
    other.larger_since.reset();
}

const std::optional<FollowedFace>& RemoteFaceFollower::decide() {
  if (followed_ && now_ - followed_->seen > rules_.hold && (followed() == nullptr || !seen_now(*followed())))
    followed_.reset();
  if (const Candidate* const seen = followed(); seen != nullptr && seen_now(*seen)) {
    followed_ = FollowedFace{seen->person, seen->box, now_};
    for (Candidate& candidate : candidates_)
      if (seen_now(candidate)) candidate.beside = seen->person;
    if (!by_hand_ && !pinned_) take_over();
  } else if (Candidate* const next = followed_ ? successor() : largest_ready(); next != nullptr) {
    follow(*next);
  }
  why_nobody_ = reason();
  return followed_;
}

NobodyFollowed RemoteFaceFollower::reason() const {
  NobodyFollowed why = NobodyFollowed::no_face;
  for (const Candidate& candidate : candidates_) {
    if (!seen_now(candidate)) continue;
    const NobodyFollowed of_this = !candidate.allowed        ? NobodyFollowed::refused
                                   : !sure_enough(candidate) ? NobodyFollowed::not_sure
                                                             : NobodyFollowed::still;
    if (why == NobodyFollowed::no_face || of_this != NobodyFollowed::refused) why = of_this;
  }
  return why;
}

bool RemoteFaceFollower::next() {
  const auto left_of = [](const Candidate* a, const Candidate* b) { return middle(a->box).x < middle(b->box).x; };
  Candidate* const current = followed();
  std::vector<Candidate*> others;
  for (Candidate& candidate : candidates_)
    if (choosable(candidate) && &candidate != current) others.push_back(&candidate);
  if (others.empty()) return false;
  std::ranges::sort(others, left_of);
  const auto right = std::ranges::find_if(
      others, [&](const Candidate* other) { return current != nullptr && left_of(current, other); });
  pinned_.reset();
  follow(right == others.end() ? *others.front() : **right);
  by_hand_ = true;
  return true;
}

bool RemoteFaceFollower::pin() {
  if (!followed_) return false;
  const cv::Rect2d& box = followed_->box;
  const cv::Size2d size(pinned_width_fh * box.height, pinned_height_fh * box.height);
  for (Candidate& candidate : candidates_)
    candidate.larger_since.reset();
  pinned_ = cv::Rect2d(middle(box) - cv::Point2d(size.width / 2, size.height / 2), size);
  return true;
}

int RemoteFaceFollower::others() const {
  const Candidate* const current = followed();
  return static_cast<int>(std::ranges::count_if(
      candidates_, [&](const Candidate& candidate) { return choosable(candidate) && &candidate != current; }));
}

}  // namespace telehug
