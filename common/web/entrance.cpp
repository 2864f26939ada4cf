// SPDX-License-Identifier: Apache-2.0
#include "web/entrance.hpp"

#include <fmt/core.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace telehug {
namespace {

std::string new_secret() {
  std::array<unsigned char, secret_digits / 2> bytes{};
  // getrandom is never short for up to 256 bytes once the kernel's pool is ready (getrandom(2)).
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "the kernel gave no random numbers for a link");
  std::string text;
  for (const unsigned char byte : bytes)
    text += fmt::format("{:02x}", byte);
  return text;
}

// Takes as long whatever the difference is, so that a secret can't be guessed digit by digit.
bool same(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned>(static_cast<unsigned char>(b[i]));
  return different == 0;
}

}  // namespace

std::string Entrance::add(Secrets& secrets, std::size_t most, Timestamp until) {
  if (secrets.size() >= most) secrets.erase(std::ranges::min_element(secrets, {}, &Secret::until));
  secrets.push_back({new_secret(), until});
  return secrets.back().text;
}

Entrance::Secrets::iterator Entrance::find(Secrets& secrets, std::string_view text, Timestamp now) {
  std::erase_if(secrets, [now](const Secret& secret) { return secret.until <= now; });
  return std::ranges::find_if(secrets, [text](const Secret& secret) { return same(secret.text, text); });
}

std::string Entrance::new_link(Timestamp now) {
  const std::lock_guard lock(mutex_);
  return add(links_, most_links, now + link_lasts);
}

std::optional<std::string> Entrance::enter(std::string_view link, Timestamp now) {
  const std::lock_guard lock(mutex_);
  const auto found = find(links_, link, now);
  if (found == links_.end()) return std::nullopt;
  links_.erase(found);
  return add(sessions_, most_sessions, now + session_lasts);
}

bool Entrance::knows(std::string_view session, Timestamp now) {
  const std::lock_guard lock(mutex_);
  const auto found = find(sessions_, session, now);
  if (found == sessions_.end()) return false;
  found->until = now + session_lasts;
  return true;
}

}  // namespace telehug
