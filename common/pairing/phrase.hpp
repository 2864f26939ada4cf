// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace telehug {

// Eight words (64 bits) of the SHA-256 of what both PCs should have in common. Somebody in between would have to find
// keys that give the same words, some 2^64 tries, while the two people wait.
[[nodiscard]] std::string phrase_of(const std::string& agreed);

}  // namespace telehug
