// SPDX-License-Identifier: Apache-2.0
//
// The two documents of DDS Security 1.1 that say what is protected (governance, 9.4.1.2) and who may do what
// (permissions, 9.4.1.3).
#pragma once

#include <optional>
#include <string>

#include "common/messages.hpp"
#include "pairing/certificates.hpp"

namespace telehug {

// Everything encrypted, nobody without a certificate: the same for every pair, since sides whose protection differs
// don't meet, and don't say why. Messages as a whole, not each payload by itself: the keys of payloads are handed over
// once for each writer, and over a long way on which packets overtake each other Fast DDS 2.9 may lose them for good.
[[nodiscard]] std::string governance();

// What `side` may do in its pair's partition: write its own topics and read the other side's (idl/README.md), nothing
// else. subject: as subject_of() tells it.
[[nodiscard]] std::string permissions(Side side, const std::string& subject, const std::string& partition,
                                      const Validity& validity);
// For how long they are given, as the text says it, signed or not.
[[nodiscard]] std::optional<Validity> validity_in(const std::string& permissions);

}  // namespace telehug
