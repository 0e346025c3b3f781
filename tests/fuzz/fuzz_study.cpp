// SPDX-License-Identifier: GPL-3.0-or-later
// Studies: a typed study, its sweep, or core::Error. Files that a study names are not there.
#include "core/error.hpp"
#include "study/document.hpp"
#include "study/study.hpp"
#include "study/sweep.hpp"
#include <cstdint>
#include <memory>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace fretwork::study;
  try {
    Document document;
    document.file = "/no such folder/fuzz.toml";
    document.text.assign(reinterpret_cast<const char*>(bytes), size);
    document.root = parse_toml(document.text, std::make_shared<const std::string>("fuzz.toml"));
    apply_contact_defaults(document.root);
    if (document.root.table()->contains("sweep"))
      static_cast<void>(read_sweep(document));
    static_cast<void>(read(document, {}));
  } catch (const fretwork::core::Error&) {
  }
  return 0;
}
