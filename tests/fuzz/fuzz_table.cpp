// SPDX-License-Identifier: GPL-3.0-or-later
// Files of numbers; the first byte says of which kind: rows of time and value, rows of any numbers, accelerograms.
#include "core/error.hpp"
#include "memory_file.hpp"
#include "study/accelerogram.hpp"
#include "study/number_rows.hpp"
#include "study/time_functions.hpp"
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace fretwork::study;
  static const fretwork::fuzz::MemoryFile file;
  if (size == 0)
    return 0;
  file.fill({reinterpret_cast<const char*>(bytes) + 1, size - 1});
  try {
    if (bytes[0] == 't')
      static_cast<void>(read_time_table(file.path()));
    else if (bytes[0] == 'a')
      static_cast<void>(read_accelerogram(file.path()));
    else
      static_cast<void>(read_number_rows(file.path()));
  } catch (const fretwork::core::Error&) {
  }
  return 0;
}
