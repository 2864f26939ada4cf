// SPDX-License-Identifier: Apache-2.0
#include "capture/virtual_rig/hand_skeleton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "capture/virtual_rig/linear_light.hpp"

namespace telehug {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;
constexpr float skin_gloss = 0.03F;
constexpr float cloth_mm = 1.5F;
constexpr float clear_of_screen_mm = 10;  // behind the middle of the ball at the pointing finger's end

// Blue, green, red of the skin in full light, Fitzpatrick I to VI.
const std::array<Tint, 6> skin_tints{Tint{176, 196, 228}, Tint{142, 174, 218}, Tint{116, 152, 206},
                                     Tint{84, 118, 172},  Tint{58, 84, 128},   Tint{44, 58, 88}};

cv::Vec3f unit(const cv::Vec3f& v) {
  return v * (1 / static_cast<float>(cv::norm(v)));
}

// Directions at a place of the hand: away from the fingertips, to the back of the hand, to the little finger.
struct Directions {
  cv::Vec3f back;
  cv::Vec3f nail;
  cv::Vec3f side;
};

Directions finger_directions(const HandPose& pose, bool left) {
  const auto approach = static_cast<float>(pose.approach_deg) * degree;
  const auto lean = static_cast<float>(pose.lean_deg) * degree;
  const float to_little = left ? -1.0F : 1.0F;
  Directions d;
  d.back = {to_little * std::sin(lean), std::cos(lean) * std::cos(approach), std::cos(lean) * std::sin(approach)};
  const cv::Vec3f x(1, 0, 0);
  d.side = unit(x - d.back * d.back.dot(x));
  d.nail = d.side.cross(d.back);  // up and to the user
  d.side *= to_little;
  const auto turn = static_cast<float>(pose.turn_deg) * degree;
  const Directions before = d;
  d.nail = before.nail * std::cos(turn) + before.side * std::sin(turn);
  d.side = before.side * std::cos(turn) - before.nail * std::sin(turn);
  return d;
}

// One joint further away from the tip: the finger is bent towards its pad.
Directions bent(const Directions& d, float angle) {
  return {d.back * std::cos(angle) - d.nail * std::sin(angle), d.nail * std::cos(angle) + d.back * std::sin(angle),
          d.side};
}

class HandBuilder {
 public:
  HandBuilder(const HandPose& pose, const HandLooks& looks)
      : pose_(pose),
        looks_(looks),
        size_(static_cast<float>(looks.finger_width_mm) / 16),
        glove_(looks.sleeve == Sleeve::glove),
        skin_(glove_ ? linear(looks.sleeve_tint) : skin_light(looks.skin_tone)) {}

  HandSkeleton build(const std::optional<cv::Vec3f>& second_end) {
    const Directions tip = finger_directions(pose_, looks_.left);
    const float bend =
        std::min(static_cast<float>(pose_.bend_deg), static_cast<float>(pose_.approach_deg - 8) / 2) * degree;
    const Directions middle = bent(tip, bend);
    const Directions base = bent(middle, bend);
    const cv::Vec3f end_joint = tip.back * mm(19);
    const cv::Vec3f middle_joint = end_joint + middle.back * mm(25);
    const cv::Vec3f knuckle = middle_joint + base.back * mm(42);
    const Directions hand = hand_directions(base);
    const std::array<cv::Vec3f, 4> knuckles{knuckle, knuckle + hand.side * mm(20) - hand.back * mm(4),
                                            knuckle + hand.side * mm(39) - hand.back * mm(1),
                                            knuckle + hand.side * mm(56) + hand.back * mm(8)};
    if (pose_.posture == Posture::forearm) {
      add_lying_forearm();
      skeleton_.pointing = 0;
      return std::move(skeleton_);
    }
    add_palm(knuckles, hand);
    add_thumb(knuckle, hand);
    if (pose_.posture == Posture::fist) {
      for (std::size_t i = 0; i < knuckles.size(); ++i)
        add_curled(knuckles[i], hand, i == 3 ? 0.85F : 1.0F);
      skeleton_.pointing = 0;
      return std::move(skeleton_);
    }
    add_finger({0, 0, 0}, end_joint, middle_joint, knuckle, tip, base.nail);
    if (second_end) add_second(*second_end, knuckles[1], tip, base.nail);
    for (std::size_t i = second_end ? 2 : 1; i < knuckles.size(); ++i)
      add_curled(knuckles[i], hand, i == 3 ? 0.85F : 1.0F);
    std::swap(skeleton_.ends[0], skeleton_.ends[1]);  // the thumb came first
    if (second_end) std::swap(skeleton_.ends[1], skeleton_.ends[2]);
    skeleton_.pointing = second_end ? 2 : 1;
    return std::move(skeleton_);
  }

 private:
  [[nodiscard]] float mm(float of_average_hand) const { return of_average_hand * size_; }

  void add(const cv::Vec3f& a, const cv::Vec3f& b, float a_mm, float b_mm, const cv::Vec3f& flat, float flatness,
           float blend_mm) {
    const float thicker = glove_ ? cloth_mm : 0;
    skeleton_.limbs.push_back(
        {a, b, mm(a_mm) + thicker, mm(b_mm) + thicker, unit(flat), flatness, blend_mm, skin_, glove_ ? 0 : skin_gloss});
  }

  // Moved off the screen if need be: only fingers that point may touch it.
  [[nodiscard]] cv::Vec3f clear(cv::Vec3f p, float radius) const {
    p[2] = std::max(p[2], mm(radius) + clear_of_screen_mm);
    return p;
  }

  // The hand goes back to the user, whose elbow is lower and further away than the screen.
  [[nodiscard]] Directions hand_directions(const Directions& base) const {
    const float to_little = looks_.left ? -1.0F : 1.0F;
    const cv::Vec3f to_elbow(to_little * 0.12F, 0.3F, 0.95F);
    Directions hand;
    hand.back = unit(base.back * 0.35F + unit(to_elbow) * 0.65F);
    hand.side = unit(base.side - hand.back * hand.back.dot(base.side));
    hand.nail = hand.side.cross(hand.back) * to_little;
    return hand;
  }

  void add_palm(const std::array<cv::Vec3f, 4>& knuckles, const Directions& hand) {
    wrist_ = knuckles[0] + hand.back * mm(80) + hand.side * mm(22) - hand.nail * mm(4);
    for (std::size_t i = 0; i < knuckles.size(); ++i) {
      const float across = static_cast<float>(i) - 1.5F;
      add(knuckles[i] - hand.nail * mm(2), wrist_ + hand.side * mm(9 * across), i == 3 ? 9 : 10.5F, 15, hand.nail, 0.9F,
          7);
    }
    const cv::Vec3f elbow_side = unit(hand.back + cv::Vec3f(0, 0.25F, 0.15F));
    const cv::Vec3f forearm = wrist_ + elbow_side * mm(220);
    add(wrist_, forearm, 22, 36, hand.nail, 0.8F, 10);
    if (looks_.sleeve == Sleeve::sleeve) {
      const cv::Vec3f cuff = wrist_ + elbow_side * mm(12);
      skeleton_.clothes.push_back(
          {cuff, forearm, mm(31), mm(45), hand.nail, 0.85F, 0.5F, linear(looks_.sleeve_tint), 0});
    }
  }

  // Leant on the desk's edge or the bezel, the hand to the side.
  void add_lying_forearm() {
    const float to_little = looks_.left ? -1.0F : 1.0F;
    const auto turn = static_cast<float>(pose_.lean_deg + pose_.turn_deg) * degree;
    const cv::Vec3f to_elbow = unit({to_little * std::cos(turn), 0.25F, 0.25F + std::abs(std::sin(turn))});
    const cv::Vec3f elbow = to_elbow * mm(230);
    const cv::Vec3f hand = to_elbow * -mm(90);
    const cv::Vec3f up(0, -1, 0);
    add({0, 0, 0}, elbow, 23, 38, up, 0.85F, 10);
    add({0, 0, 0}, hand, 25, 20, up, 0.75F, 10);
    if (looks_.sleeve == Sleeve::sleeve) {
      skeleton_.clothes.push_back(
          {to_elbow * mm(12), elbow, mm(30), mm(46), up, 0.9F, 0.5F, linear(looks_.sleeve_tint), 0});
    }
  }

  void add_thumb(const cv::Vec3f& knuckle, const Directions& hand) {
    const auto place = [&](float back, float side, float nail) {
      return knuckle + hand.back * mm(back) + hand.side * mm(side) + hand.nail * mm(nail);
    };
    const cv::Vec3f base = place(58, 4, -10);
    const cv::Vec3f middle = clear(place(26, -20, -12), 12);
    const cv::Vec3f joint = clear(place(-2, -32, -13), 10);
    const cv::Vec3f end = clear(place(-22, -34, -15), 8);
    add(base, middle, 15, 12, hand.nail, 1, 8);
    add(middle, joint, 11.5F, 9.5F, hand.nail, 1, 1.5F);
    add(joint, end, 9.5F, 7.5F, hand.nail, 0.9F, 1);
    const cv::Vec3f back = unit(joint - end);
    const cv::Vec3f nail = unit(hand.nail - back * back.dot(hand.nail));
    const float to_little = looks_.left ? -1.0F : 1.0F;
    skeleton_.ends.push_back({end, back, nail, back.cross(nail) * to_little, mm(7.5F), 0.85F, 1.0F});
  }

  void add_finger(const cv::Vec3f& end, const cv::Vec3f& end_joint, const cv::Vec3f& middle_joint,
                  const cv::Vec3f& knuckle, const Directions& tip, const cv::Vec3f& base_nail) {
    const std::size_t first = skeleton_.limbs.size();
    const auto flatness = static_cast<float>(looks_.tip_flatness);
    add(end, end_joint, static_cast<float>(looks_.tip_radius_mm), 7.9F, tip.nail, flatness, 0.6F);
    if (looks_.pulp_mm > 0) add_pulp(end, tip, flatness);
    const std::size_t end_limbs = skeleton_.limbs.size() - first;
    add(end_joint, middle_joint, 7.8F, 8.6F, tip.nail, 0.9F, 0.6F);
    add(middle_joint, knuckle, 8.6F, 10.2F, base_nail, 0.95F, 1.5F);
    skeleton_.pointing_limbs.insert(skeleton_.pointing_limbs.end(),
                                    skeleton_.limbs.begin() + static_cast<std::ptrdiff_t>(first),
                                    skeleton_.limbs.begin() + static_cast<std::ptrdiff_t>(first + end_limbs) + 1);
    skeleton_.ring_finger_segment = skeleton_.limbs.back();
    skeleton_.ends.push_back({end, tip.back, tip.nail, tip.side, skeleton_.limbs[first].a_radius_mm, flatness, 0.5F});
  }

  void add_pulp(const cv::Vec3f& end, const Directions& tip, float flatness) {
    const auto ball_mm = static_cast<float>(looks_.tip_radius_mm);
    const float radius_mm = 0.7F * ball_mm;
    const cv::Vec3f from = end - tip.nail * mm(flatness * (ball_mm - radius_mm) + static_cast<float>(looks_.pulp_mm)) +
                           tip.side * mm(static_cast<float>(looks_.pulp_side_mm));
    add(from + tip.back * mm(1), from + tip.back * mm(8), radius_mm, radius_mm, tip.nail, flatness, 3);
  }

  // The middle joint of the second finger lies where both of its bones reach, on the nail's side; bones that are too
  // short are stretched.
  void add_second(const cv::Vec3f& end, const cv::Vec3f& knuckle, const Directions& tip, const cv::Vec3f& base_nail) {
    const cv::Vec3f end_joint = end + tip.back * mm(19);
    const cv::Vec3f way = knuckle - end_joint;
    const auto distance = static_cast<float>(cv::norm(way));
    const float stretched = std::max(1.0F, distance / mm(26 + 44) * 1.001F);
    const float near_mm = mm(26) * stretched;
    const float far_mm = mm(44) * stretched;
    const cv::Vec3f along = unit(way);
    const float share = (distance * distance + near_mm * near_mm - far_mm * far_mm) / (2 * distance);
    const float above = std::sqrt(std::max(0.0F, near_mm * near_mm - share * share));
    const cv::Vec3f up = unit(tip.nail - along * along.dot(tip.nail));
    add_finger(end, end_joint, end_joint + along * share + up * above, knuckle, tip, base_nail);
  }

  void add_curled(const cv::Vec3f& knuckle, const Directions& hand, float length) {
    const cv::Vec3f middle = clear(knuckle - hand.back * mm(15 * length) - hand.nail * mm(28 * length), 9);
    const cv::Vec3f end = clear(middle + hand.back * mm(19 * length) - hand.nail * mm(8 * length), 8);
    const cv::Vec3f tip = clear(end + hand.back * mm(16 * length) + hand.nail * mm(4 * length), 8);
    add(knuckle - hand.nail * mm(2), middle, 9.8F * length, 8.8F * length, hand.side, 1, 3);
    add(middle, end, 8.6F * length, 8 * length, hand.side, 1, 1.5F);
    add(end, tip, 8 * length, 7.5F * length, hand.side, 1, 1.5F);
  }

  const HandPose& pose_;
  const HandLooks& looks_;
  float size_;
  bool glove_;
  cv::Vec3f skin_;
  cv::Vec3f wrist_;
  HandSkeleton skeleton_;
};

}  // namespace

cv::Vec3f skin_light(int skin_tone) {
  return linear(skin_tints[static_cast<std::size_t>(std::clamp(skin_tone, 1, 6) - 1)]);
}

HandSkeleton hand_skeleton(const HandPose& pose, const HandLooks& looks, const std::optional<cv::Vec3f>& second_end) {
  return HandBuilder(pose, looks).build(second_end);
}

}  // namespace telehug
