// SPDX-License-Identifier: Apache-2.0
//
// Root at the files of somebody else: `sudo telehug pair` in the folder of the service's account.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace telehug {

// As long as it lives, a process of root acts as the owner of a folder, or of the nearest one above it that is there:
// what it makes there is readable to them, and no link that they may have laid leads it to what is not theirs. Does
// nothing for anybody but root, nor in root's own folders. Throws std::system_error if the kernel refuses. One thread
// only.
class AsOwnerOf {
 public:
  explicit AsOwnerOf(std::filesystem::path folder);
  ~AsOwnerOf();
  AsOwnerOf(const AsOwnerOf&) = delete;
  AsOwnerOf& operator=(const AsOwnerOf&) = delete;
  AsOwnerOf(AsOwnerOf&&) = delete;
  AsOwnerOf& operator=(AsOwnerOf&&) = delete;

 private:
  uid_t user_;
  gid_t group_;
};

// As long as it lives, the process acts again as who started it, for the files that they named themselves.
class AsCaller {
 public:
  AsCaller();
  ~AsCaller();
  AsCaller(const AsCaller&) = delete;
  AsCaller& operator=(const AsCaller&) = delete;
  AsCaller(AsCaller&&) = delete;
  AsCaller& operator=(AsCaller&&) = delete;

 private:
  uid_t user_;
  gid_t group_;
};

}  // namespace telehug
