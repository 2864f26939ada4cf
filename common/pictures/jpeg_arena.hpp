// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>  // jpeglib.h needs it first
#include <vector>

#include <jpeglib.h>

namespace telehug {

// Memory for what libjpeg needs while it decodes one picture. libjpeg by itself allocates and frees some 30 blocks a
// picture; the arena keeps one block that is as large as the largest picture so far needed.
class JpegArena {
 public:
  // Takes the place of the decoder's own memory for pictures. `find` leads from a decoder to its arena. The arena must
  // outlive the decoder's last use, except for its destruction.
  using Find = JpegArena& (*)(j_common_ptr);
  template <Find find>
  void serve(jpeg_decompress_struct& codec) {
    own_ = *codec.mem;
    codec.mem->alloc_small = [](j_common_ptr c, int pool, std::size_t size) {
      return find(c).allocate(c, pool, size, find(c).own_.alloc_small);
    };
    codec.mem->alloc_large = [](j_common_ptr c, int pool, std::size_t size) {
      return find(c).allocate(c, pool, size, find(c).own_.alloc_large);
    };
    codec.mem->alloc_sarray = [](j_common_ptr c, int pool, JDIMENSION samples, JDIMENSION rows) {
      return find(c).rows<JSAMPLE>(c, pool, samples, rows);
    };
    codec.mem->alloc_barray = [](j_common_ptr c, int pool, JDIMENSION blocks, JDIMENSION rows) {
      return find(c).rows<JBLOCK>(c, pool, blocks, rows);
    };
    codec.mem->free_pool = [](j_common_ptr c, int pool) { find(c).free_pool(c, pool); };
  }

 private:
  using Allocate = void* (*)(j_common_ptr, int, std::size_t);

  // From the block if it fits there, else from libjpeg; the block grows when the picture is over.
  void* allocate(j_common_ptr codec, int pool, std::size_t size, Allocate otherwise);
  void free_pool(j_common_ptr codec, int pool);

  // Row pointers and rows that begin, as libjpeg's vector code expects, at multiples of 64 bytes.
  template <typename Cell>
  Cell** rows(j_common_ptr codec, int pool, std::size_t cells, std::size_t count) {
    const std::size_t row_bytes = rounded(cells * sizeof(Cell));
    auto** pointers = static_cast<Cell**>(allocate(codec, pool, count * sizeof(Cell*), own_.alloc_small));
    auto* bytes = static_cast<std::byte*>(allocate(codec, pool, count * row_bytes, own_.alloc_large));
    for (std::size_t row = 0; row < count; ++row)
      pointers[row] = reinterpret_cast<Cell*>(bytes + row * row_bytes);
    return pointers;
  }

  static constexpr std::size_t alignment = 64;
  static constexpr std::size_t rounded(std::size_t size) { return (size + alignment - 1) / alignment * alignment; }

  jpeg_memory_mgr own_{};
  std::vector<std::byte> block_;
  std::size_t used_ = 0;
  std::size_t needed_ = 0;
};

}  // namespace telehug
