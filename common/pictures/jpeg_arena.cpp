// SPDX-License-Identifier: Apache-2.0
#include "pictures/jpeg_arena.hpp"

#include <memory>
#include <new>

namespace telehug {

void* JpegArena::allocate(j_common_ptr codec, int pool, std::size_t size, Allocate otherwise) {
  if (pool != JPOOL_IMAGE) return otherwise(codec, pool, size);
  needed_ += rounded(size) + alignment;
  void* place = block_.data() + used_;
  std::size_t space = block_.size() - used_;
  if (block_.empty() || std::align(alignment, rounded(size), place, space) == nullptr) {
    return otherwise(codec, pool, size);
  }
  used_ = block_.size() - space + rounded(size);
  return place;
}

void JpegArena::free_pool(j_common_ptr codec, int pool) {
  own_.free_pool(codec, pool);
  if (pool != JPOOL_IMAGE) return;
  try {
    if (needed_ > block_.size()) block_.resize(needed_);
  } catch (const std::bad_alloc&) {
    block_ = {};  // libjpeg goes on with memory of its own; an exception must not pass through it
  }
  used_ = 0;
  needed_ = 0;
}

}  // namespace telehug
