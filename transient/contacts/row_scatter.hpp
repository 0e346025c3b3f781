// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Forces on contacts as forces on the modes that these move.
#pragma once
#include "transient/contacts/packed_contacts.hpp"
#include <array>

namespace fretwork::transient {

/// A list of rows y, z, x of contacts. Each costs the modes of its spans; rows of the same spans that follow each other are added together.
class RowScatter {
public:
  /// @param contacts  must live longer
  explicit RowScatter(const PackedContacts& contacts);
  void clear() { count_ = 0; }
  /// No allocation; each row once at most.
  void add(int contact, int component) {
    rows_[count_] = contacts_.row(contact, component);
    contact_[count_++] = contact;
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  /// target += sum of factor times row, in the order of the list; padded modes. No allocation.
  /// @param factors  one for each row of the list
  void add_to(const double* factors, double* target) { add_to({{{factors, target}}}, 1); }
  /// To the first `count` of some targets.
  using Targets = std::array<kernels::ScatterTarget, kernels::most_scattered>;
  void add_to(Targets targets, int count);

private:
  const PackedContacts& contacts_;
  std::vector<const double*> rows_, parts_; ///< rows; their part in a span
  std::vector<int> contact_;
  std::size_t count_ = 0;
};

} // namespace fretwork::transient
