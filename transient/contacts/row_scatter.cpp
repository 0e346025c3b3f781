// SPDX-License-Identifier: GPL-3.0-or-later
#include "transient/contacts/row_scatter.hpp"

namespace fretwork::transient {

RowScatter::RowScatter(const PackedContacts& contacts) : contacts_(contacts) {
  const std::size_t most = 3 * static_cast<std::size_t>(contacts.count);
  rows_.resize(most);
  parts_.resize(most);
  contact_.resize(most);
}

void RowScatter::add_to(Targets targets, int count) {
  for (std::size_t begin = 0, end = 0; begin < count_; begin = end) {
    const auto c = static_cast<std::size_t>(contact_[begin]);
    for (; end < count_ && contacts_.layout[static_cast<std::size_t>(contact_[end])] == contacts_.layout[c];
         ++end)
      parts_[end] = rows_[end];
    for (const PackedContacts::Span& span : contacts_.spans[c]) {
      Targets here = targets;
      for (kernels::ScatterTarget& target : here)
        if (target.v)
          target = {target.factor + begin, target.v + span.first};
      const int rows = static_cast<int>(end - begin);
      if (count == 1)
        kernels::scatter(span.size, rows, &parts_[begin], here[0].factor, here[0].v);
      else
        kernels::scatter_several(span.size, rows, &parts_[begin], count, here.data());
      for (std::size_t r = begin; r < end; ++r)
        parts_[r] += span.size;
    }
  }
}

} // namespace fretwork::transient
