// SPDX-License-Identifier: Apache-2.0
//
// What each exit code means, in the words of --help and of the manual.
#pragma once

#include <array>
#include <string_view>

#include "service/exit_code.hpp"

namespace telehug {

inline constexpr std::array all_exit_codes{
    ExitCode::ok,         ExitCode::internal,    ExitCode::usage,           ExitCode::config,
    ExitCode::device,     ExitCode::not_running, ExitCode::peer_absent,     ExitCode::permission,
    ExitCode::bad_answer, ExitCode::refused,     ExitCode::already_running, ExitCode::stopped,
    ExitCode::fault,      ExitCode::network,     ExitCode::mismatch,        ExitCode::pair_ended,
};

[[nodiscard]] constexpr std::string_view exit_code_text(ExitCode code) noexcept {
  switch (code) {  // without a default, so that g++ finds a code that lacks its words
    case ExitCode::ok:
      return "all is well";
    case ExitCode::internal:
      return "a fault of telehug itself, or its output can't be written";
    case ExitCode::usage:
      return "the command line can't be understood";
    case ExitCode::config:
      return "the configuration has faults";
    case ExitCode::device:
      return "a camera, screen, jacket, recording or programmer that was asked for can't be used";
    case ExitCode::not_running:
      return "no daemon answers on the local socket";
    case ExitCode::peer_absent:
      return "the other side isn't connected (only where a command asks for it)";
    case ExitCode::permission:
      return "the local socket, or the service's pairs, may not be used by this user";
    case ExitCode::bad_answer:
      return "the daemon did not answer in time, or not in its language";
    case ExitCode::refused:
      return "the daemon understood and refused, or you did when asked";
    case ExitCode::already_running:
      return "another daemon serves the same socket";
    case ExitCode::stopped:
      return "stop is latched, or the wearer has paused (only where a command asks for it)";
    case ExitCode::fault:
      return "something can't work as it is (only where a command asks for it)";
    case ExitCode::network:
      return "the network can't be used as was asked for";
    case ExitCode::mismatch:
      return "a demo or comparison ran, and what came out is not what should have";
    case ExitCode::pair_ended:
      return "the pair was revoked or has expired, or is not valid yet by this PC's clock";
  }
  return {};
}

}  // namespace telehug
