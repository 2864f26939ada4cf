// SPDX-License-Identifier: Apache-2.0
#include "dds/participant_number.hpp"
#include "dds/dds_error.hpp"

#include <bitset>
#include <mutex>
#include <stdexcept>

namespace telehug {

namespace {

struct Numbers {
  std::mutex mutex;
  std::bitset<max_participants> taken;
};

Numbers& numbers() {
  static Numbers instance;
  return instance;
}

}  // namespace

ParticipantNumber::ParticipantNumber() {
  const std::lock_guard lock(numbers().mutex);
  while (numbers().taken.test(number_)) {
    if (++number_ == max_participants) throw DdsError("this program has too many DDS participants");
  }
  numbers().taken.set(number_);
}

ParticipantNumber::~ParticipantNumber() {
  if (used_up_) return;
  const std::lock_guard lock(numbers().mutex);
  numbers().taken.reset(number_);
}

}  // namespace telehug
