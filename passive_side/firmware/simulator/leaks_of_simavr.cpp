// SPDX-License-Identifier: Apache-2.0
//
// Only in builds with the address sanitizer: libsimavr 1.6 does not free the names and the list of its signals.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)

extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libsimavr\n";
}
