// SPDX-License-Identifier: Apache-2.0
#include "publish/touch_stream.hpp"

#include <algorithm>

namespace telehug {

const TouchEvent* TouchStream::build(const BoxedContacts& fingers, std::uint32_t body_map_version, bool sending,
                                     Timestamp frame_time, Timestamp now) {
  const BoxedContacts& hug = hug_.play(now);
  if (!sending) builder_.withhold_downs_except(hug);
  BoxedContacts contacts = hug;
  if (sending) {
    const std::size_t room = contacts.capacity() - contacts.size();
    contacts.insert(contacts.end(), fingers.begin(),
                    fingers.begin() + static_cast<std::ptrdiff_t>(std::min(room, fingers.size())));
  }
  const std::uint32_t version = body_map_version == 0 && !hug.empty() ? no_face_version : body_map_version;
  // A frame was taken a little before it is looked at, perhaps before an event that needed none.
  newest_ = std::max(frame_time, newest_ + Duration{1});
  return builder_.build(contacts, version, newest_, now);
}

}  // namespace telehug
