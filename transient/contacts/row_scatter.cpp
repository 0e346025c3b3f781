// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/row_scatter.hpp"

namespace fretwork::transient {

RowScatter::RowScatter(const PackedContacts& contacts) : contacts_(contacts) {
  const std::size_t most = 3 * static_cast<std::size_t>(contacts.count);
  rows_.resize(most);
  parts_.resize(most);
  contact_.resize(most);
}

void RowScatter::add_to(const double* factors, double* target) {
  for (std::size_t begin = 0, end = 0; begin < count_; begin = end) {
    const auto c = static_cast<std::size_t>(contact_[begin]);
    for (; end < count_ && contacts_.layout[static_cast<std::size_t>(contact_[end])] == contacts_.layout[c];
         ++end)
      parts_[end] = rows_[end];
    for (const PackedContacts::Span& span : contacts_.spans[c]) {
      kernels::scatter(span.size, static_cast<int>(end - begin), &parts_[begin], factors + begin,
                       target + span.first);
      for (std::size_t r = begin; r < end; ++r)
        parts_[r] += span.size;
    }
  }
}

} // namespace fretwork::transient
