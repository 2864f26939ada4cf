// SPDX-License-Identifier: Apache-2.0
#include "screen_portal/screen_share.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>

#include "screen_portal/restore_token.hpp"

namespace telehug {
namespace {

constexpr const char* asking_portal = "The desktop's portal is asked for the screen.";
constexpr const char* waiting_for_consent =
    "The picture of the screen waits for your consent in the dialogue of the desktop: choose there the monitor that "
    "the webcam looks at.";
constexpr const char* waiting_for_stream = "The desktop shares its screen, but no picture flows now.";

int poll_timeout_ms(Timestamp until, Timestamp now) {
  if (until == Timestamp::max()) return -1;
  const auto wait = std::chrono::ceil<std::chrono::milliseconds>(until - now);
  return static_cast<int>(std::clamp<std::int64_t>(wait.count(), 0, 60'000));
}

}  // namespace

ScreenShare::ScreenShare(ScreenShareConfig config, const Clock& clock)
    : config_(std::move(config)), clock_(clock), next_try_(clock.now()) {
  state_.trouble = asking_portal;
  wake_fd_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_fd_ < 0)
    throw std::system_error(errno, std::generic_category(), "no event can be made to end a thread with");
  thread_ = std::thread([this] { run(); });
}

ScreenShare::~ScreenShare() {
  ending_ = true;
  const std::uint64_t one = 1;
  static_cast<void>(!::write(wake_fd_, &one, sizeof one));
  thread_.join();
  ::close(wake_fd_);
}

ScreenShareState ScreenShare::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void ScreenShare::run() {
  while (!ending_) {
    try {
      if (!session_ && clock_.now() >= next_try_) begin();
      if (session_) serve();
    } catch (const std::exception& fault) {  // such as no memory
      stream_.reset();
      session_.reset();
      next_try_ = clock_.now() + config_.retry_after;
      say(false, fmt::format("The screen can't be shared ({}); it is tried again by itself.", fault.what()));
    }
    if (!ending_) wait();
  }
  stream_.reset();
  session_.reset();
}

void ScreenShare::begin() {
  has_consent_ = consent_is_kept_ = false;
  session_ = std::make_unique<PortalSession>(
      config_.bus_address, use_token_ ? read_restore_token(config_.token_file) : std::string{}, clock_);
}

void ScreenShare::serve() {
  session_->process();
  if (session_->consented() && !std::exchange(has_consent_, true)) keep_token();
  if (session_->failure()) return give_up(*session_->failure());
  if (const auto screen = session_->take_screen()) {
    stream_ = std::make_unique<PipeWireStream>(screen->pipewire_fd, screen->node, frames_);
  }
  if (stream_) {
    serve_stream();
  } else {
    say(false, session_->asked() ? waiting_for_consent : asking_portal);
  }
}

void ScreenShare::serve_stream() {
  stream_->process();
  switch (stream_->state()) {
    case PipeWireStream::State::failed:
      return give_up({stream_->failure(), PortalRetry::soon});
    case PipeWireStream::State::waiting:
      return say(false, waiting_for_stream);
    case PipeWireStream::State::flowing:
      return say(true, {});
  }
}

void ScreenShare::keep_token() {
  use_token_ = true;
  std::string remark;
  if (!session_->new_token().empty()) {
    const Status written = write_restore_token(config_.token_file, session_->new_token());
    consent_is_kept_ = written.ok();
    if (!written) remark = written.error().message;
  } else {
    // The old one was good for one time only.
    remove_restore_token(config_.token_file);
    remark = fmt::format(
        "The desktop's portal (version {}) does not remember your consent to share the screen and asks at each start.",
        session_->version());
  }
  const std::lock_guard lock(mutex_);
  state_.remark = std::move(remark);
}

void ScreenShare::give_up(PortalFailure failure) {
  const bool was_asked = session_->asked();
  stream_.reset();
  session_.reset();
  if (failure.retry == PortalRetry::without_token) {
    use_token_ = false;  // should it not be possible to remove it
    remove_restore_token(config_.token_file);
    next_try_ = clock_.now();
    return say(false, asking_portal);
  }
  if (failure.retry == PortalRetry::at_users_word) use_token_ = false;
  // The user is not shown one dialogue after the other.
  const bool asks_user = failure.retry == PortalRetry::at_users_word || (was_asked && !consent_is_kept_);
  next_try_ = clock_.now() + (asks_user ? config_.ask_again_after : config_.retry_after);
  if (!asks_user) return say(false, std::move(failure.message));
  say(false,
      fmt::format("{} You are asked again in {} minutes, or at once when telehug is started anew.", failure.message,
                  std::chrono::duration_cast<std::chrono::minutes>(config_.ask_again_after).count()));
}

void ScreenShare::wait() {
  std::array<pollfd, 3> entries{};
  entries[0] = {wake_fd_, POLLIN, 0};
  entries[1].fd = -1;
  entries[2] = {stream_ ? stream_->fd() : -1, POLLIN, 0};
  const Timestamp until = session_ ? session_->wait_for(entries[1]) : next_try_;
  ::poll(entries.data(), entries.size(), poll_timeout_ms(until, clock_.now()));
}

void ScreenShare::say(bool flowing, std::string trouble) {
  const std::lock_guard lock(mutex_);
  state_.flowing = flowing;
  state_.trouble = std::move(trouble);
}

}  // namespace telehug
