// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/canonical_order.hpp"
#include "mesh/near_nodes.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <compare>
#include <numeric>
#include <tuple>

namespace fretwork::mesh {
namespace {

constexpr double rounding = 1e-10; ///< of the extent: above a mesher's noise, below any length that matters

/// A line walked from nodes[reversed] to the other end.
struct Step {
  Index line;
  bool reversed;
};
using Chain = std::vector<Step>;

/// Equal ranks where nodes compare equal.
std::vector<Index> node_ranks(std::span<const Vec3> nodes, std::span<const Index> labels) {
  const double unit = std::max(rounding * extent(nodes), 1e-300);
  using Key = std::tuple<std::array<double, 3>, std::array<double, 3>, Index>;
  std::vector<std::pair<Key, Index>> keys(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3& x = nodes[i];
    keys[i] = {Key{{std::round(x.x() / unit), std::round(x.y() / unit), std::round(x.z() / unit)},
                   {x.x(), x.y(), x.z()},
                   labels[i]},
               static_cast<Index>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Index> rank(nodes.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    rank[keys[i].second] =
        i > 0 && keys[i].first == keys[i - 1].first ? rank[keys[i - 1].second] : static_cast<Index>(i);
  return rank;
}

/// One pass from the lines to the ordered chains.
class Walker {
public:
  Walker(std::span<const Vec3> nodes, std::span<const RawLine> lines, const Labels& labels)
      : lines_(lines), labels_(labels), rank_(node_ranks(nodes, labels.of_node)), walked_(lines.size(), 0) {
    list_incident(nodes.size());
  }
  CanonicalOrder order();

private:
  void list_incident(std::size_t node_count);
  std::span<const Index> incident(Index node) const {
    return std::span(incident_).subspan(first_[node], first_[node + 1] - first_[node]);
  }
  Index start(Step s) const { return lines_[s.line].nodes[s.reversed ? 1 : 0]; }
  Index end(Step s) const { return lines_[s.line].nodes[s.reversed ? 0 : 1]; }
  Chain walk(Index node, Index line);
  Chain turned(const Chain& chain) const;
  void start_ring(Chain& ring) const;
  std::weak_ordering compare(const Chain& a, const Chain& b) const;
  void find_chains();
  void sort_by_structure();

  std::span<const RawLine> lines_;
  const Labels& labels_;
  std::vector<Index> rank_;
  std::vector<char> walked_;
  std::vector<Index> first_, incident_; ///< lines at each node, one list after the other
  std::vector<Chain> chains_;
};

void Walker::list_incident(std::size_t node_count) {
  first_.assign(node_count + 1, 0);
  for (const RawLine& line : lines_)
    for (const Index node : line.nodes)
      ++first_[node + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  incident_.resize(2 * lines_.size());
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < lines_.size(); ++i)
    for (const Index node : lines_[i].nodes)
      incident_[next[node]++] = static_cast<Index>(i);
}

/// From `node` over `line` to the next end or junction, or round a ring back to its start.
Chain Walker::walk(Index node, Index line) {
  Chain chain;
  while (!walked_[line]) {
    walked_[line] = 1;
    chain.push_back({line, lines_[line].nodes[0] != node});
    node = end(chain.back());
    const auto here = incident(node);
    if (here.size() != 2)
      break;
    line = here[0] == line ? here[1] : here[0];
  }
  return chain;
}

Chain Walker::turned(const Chain& chain) const {
  Chain back(chain.rbegin(), chain.rend());
  for (Step& step : back)
    step.reversed = !step.reversed;
  return back;
}

void Walker::start_ring(Chain& ring) const {
  const auto smallest = std::min_element(ring.begin(), ring.end(),
                                         [&](Step a, Step b) { return rank_[start(a)] < rank_[start(b)]; });
  std::rotate(ring.begin(), smallest, ring.end());
}

std::weak_ordering Walker::compare(const Chain& a, const Chain& b) const {
  if (const auto order = rank_[start(a[0])] <=> rank_[start(b[0])]; order != 0)
    return order;
  const auto middle = [&](Step s) { return lines_[s.line].middle < 0 ? -1 : rank_[lines_[s.line].middle]; };
  const std::size_t common = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (const auto order = middle(a[i]) <=> middle(b[i]); order != 0)
      return order;
    if (const auto order = rank_[end(a[i])] <=> rank_[end(b[i])]; order != 0)
      return order;
  }
  if (a.size() != b.size())
    return a.size() <=> b.size();
  for (std::size_t i = 0; i < common; ++i)
    if (const auto order = labels_.of_line[a[i].line] <=> labels_.of_line[b[i].line]; order != 0)
      return order;
  return std::weak_ordering::equivalent;
}

void Walker::find_chains() {
  const auto add = [&](Chain chain) {
    Chain back = turned(chain);
    chains_.push_back(compare(back, chain) < 0 ? std::move(back) : std::move(chain));
  };
  for (Index node = 0; node + 1 < static_cast<Index>(first_.size()); ++node)
    if (const auto here = incident(node); here.size() != 2)
      for (const Index line : here)
        if (!walked_[line])
          add(walk(node, line));
  for (Index line = 0; line < static_cast<Index>(lines_.size()); ++line)
    if (!walked_[line]) {
      Chain ring = walk(lines_[line].nodes[0], line);
      start_ring(ring); // the turned ring starts at the same node: its last end is this start
      add(std::move(ring));
    }
}

/// Chains by their sequence, then gathered structure by structure.
void Walker::sort_by_structure() {
  std::stable_sort(chains_.begin(), chains_.end(),
                   [&](const Chain& a, const Chain& b) { return compare(a, b) < 0; });
  std::vector<Index> parent(first_.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Chain& chain : chains_)
    parent[root(start(chain.front()))] = root(end(chain.back()));
  std::vector<Index> smallest(parent.size(), static_cast<Index>(parent.size()));
  std::vector<Index> first_chain(parent.size(), -1);
  std::vector<Index> order(chains_.size());
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    order[c] = static_cast<Index>(c);
    const Index r = root(start(chains_[c].front()));
    if (first_chain[r] < 0)
      first_chain[r] = static_cast<Index>(c);
    for (const Step step : chains_[c])
      smallest[r] = std::min({smallest[r], rank_[start(step)], rank_[end(step)]});
  }
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Index ra = root(start(chains_[a].front())), rb = root(start(chains_[b].front()));
    return std::tie(smallest[ra], first_chain[ra]) < std::tie(smallest[rb], first_chain[rb]);
  });
  std::vector<Chain> sorted;
  sorted.reserve(chains_.size());
  for (const Index c : order)
    sorted.push_back(std::move(chains_[c]));
  chains_ = std::move(sorted);
}

CanonicalOrder Walker::order() {
  find_chains();
  sort_by_structure();
  CanonicalOrder result;
  std::vector<char> numbered(rank_.size(), 0);
  const auto number = [&](Index node) {
    if (node >= 0 && !numbered[node]) {
      numbered[node] = 1;
      result.nodes.push_back(node);
    }
  };
  for (const Chain& chain : chains_)
    for (const Step step : chain) {
      number(start(step));
      number(lines_[step.line].middle);
      number(end(step));
      result.lines.push_back(step.line);
      result.reversed.push_back(step.reversed ? 1 : 0);
    }
  const std::size_t on_lines = result.nodes.size();
  for (std::size_t i = 0; i < rank_.size(); ++i)
    number(static_cast<Index>(i));
  std::stable_sort(result.nodes.begin() + static_cast<std::ptrdiff_t>(on_lines), result.nodes.end(),
                   [&](Index a, Index b) { return rank_[a] < rank_[b]; });
  return result;
}

/// Refine the labels by each group in turn. New labels follow the order of the old ones, never that of the
/// members.
void label_members(std::vector<Index>& labels, const Groups& groups) {
  Index next = 1;
  for (const auto& [name, members] : groups) {
    std::vector<Index> old;
    for (const Index member : members)
      old.push_back(labels[member]);
    std::sort(old.begin(), old.end());
    old.erase(std::unique(old.begin(), old.end()), old.end());
    std::vector<Index> once(members.begin(), members.end());
    std::sort(once.begin(), once.end());
    once.erase(std::unique(once.begin(), once.end()), once.end());
    for (const Index member : once)
      labels[member] =
          next + static_cast<Index>(std::lower_bound(old.begin(), old.end(), labels[member]) - old.begin());
    next += static_cast<Index>(old.size());
  }
}

} // namespace

Labels group_labels(const RawMesh& mesh) {
  Labels labels{std::vector<Index>(mesh.nodes.size(), 0), std::vector<Index>(mesh.lines.size(), 0)};
  label_members(labels.of_node, mesh.points);
  label_members(labels.of_line, mesh.curves);
  return labels;
}

CanonicalOrder canonical_order(std::span<const Vec3> nodes, std::span<const RawLine> lines,
                               const Labels& labels) {
  assert(labels.of_node.size() == nodes.size() && labels.of_line.size() == lines.size());
  return Walker(nodes, lines, labels).order();
}

} // namespace fretwork::mesh
