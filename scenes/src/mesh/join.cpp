// SPDX-License-Identifier: Apache-2.0
// 1. End points become numbered nodes. 2. At each node, pieces that go straight on are paired: chains of pieces.
// 3. Along a chain, a piece grows while all its inner nodes stay near it (the cone of allowed directions: Williams
// 1978, Sklansky and Gonzalez 1980).
#include "mesh/join.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace evigrid::scenes {
namespace {

using raycast::Point;
using Node = std::uint32_t;
constexpr std::uint32_t kNobody = 0xffffffffu;
/// Every two of the pieces that meet at a node are compared. Outlines meet by twos and fours; a star of thousands stays
/// as it is.
constexpr std::size_t kMostMeeting = 256;

Point operator-(Point a, Point b) { return {a.x_m - b.x_m, a.y_m - b.y_m}; }
double cross(Point a, Point b) { return a.x_m * b.y_m - a.y_m * b.x_m; }
double dot(Point a, Point b) { return a.x_m * b.x_m + a.y_m * b.y_m; }
bool before(Point a, Point b) { return a.x_m != b.x_m ? a.x_m < b.x_m : a.y_m < b.y_m; }

/// Points nearer to one another than the tolerance become one: each is compared with the nodes of its square of a hash
/// grid and of the eight around it.
class Nodes {
 public:
  explicit Nodes(double tolerance) : tolerance_(tolerance) {}

  Node number(Point p) {
    const double x = std::floor(p.x_m / tolerance_), y = std::floor(p.y_m / tolerance_);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const auto square = first_.find(key(x + dx, y + dy));
        for (Node n = square == first_.end() ? kNobody : square->second; n != kNobody; n = next_[n]) {
          const Point d = at[n] - p;
          if (dot(d, d) <= tolerance_ * tolerance_) return n;
        }
      }
    }
    const auto node = static_cast<Node>(at.size());
    at.push_back(p);
    const auto [square, is_new] = first_.try_emplace(key(x, y), node);
    next_.push_back(is_new ? kNobody : std::exchange(square->second, node));
    return node;
  }

  std::vector<Point> at;

 private:
  static std::uint64_t key(double x, double y) {  // equal squares have equal keys; others may, which costs time only
    const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v + 0.0); };  // + 0: one zero
    const std::uint64_t k = bits(x) * 0x9e3779b97f4a7c15u ^ std::rotl(bits(y) * 0xd1342543de82ef95u, 32);
    return k ^ k >> 29;
  }
  double tolerance_;
  std::unordered_map<std::uint64_t, Node> first_;  // of the nodes of a square; next_ leads to the others
  std::vector<Node> next_;
};

struct Edge {
  std::array<Node, 2> ends;
  std::array<std::uint32_t, 2> next{kNobody, kNobody};  // the edge that goes straight on beyond each end
  bool used = false;
  [[nodiscard]] Node other(Node n) const { return ends[0] == n ? ends[1] : ends[0]; }
};

class Joiner {
 public:
  Joiner(std::vector<LinePiece> pieces, double tolerance) : tolerance_(tolerance), nodes_(tolerance) {
    for (LinePiece& p : pieces)
      if (before(p.second, p.first)) std::swap(p.first, p.second);
    std::sort(pieces.begin(), pieces.end(), [](const LinePiece& p, const LinePiece& q) {
      if (before(p.first, q.first) || before(q.first, p.first)) return before(p.first, q.first);
      return before(p.second, q.second);
    });
    std::vector<std::array<Node, 2>> ends;
    for (const LinePiece& p : pieces) {
      const Node a = nodes_.number(p.first), b = nodes_.number(p.second);
      if (a != b) ends.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const auto& e : ends) edges_.push_back({.ends = e});
  }

  std::vector<LinePiece> join() {
    pair_up();
    for (std::uint32_t e = 0; e < edges_.size(); ++e)  // chains that end somewhere, then those that go round
      for (const std::size_t end : {0u, 1u})
        if (!edges_[e].used && edges_[e].next[end] == kNobody) follow(e, edges_[e].ends[end]);
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      if (!edges_[e].used) follow(e, edges_[e].ends[0]);
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    std::vector<LinePiece> pieces;
    for (const auto& [a, b] : found_) pieces.emplace_back(nodes_.at[a], nodes_.at[b]);
    return pieces;
  }

 private:
  [[nodiscard]] Point at(Node n) const { return nodes_.at[n]; }
  [[nodiscard]] std::size_t end_of(std::uint32_t e, Node n) const { return edges_[e].ends[0] == n ? 0 : 1; }

  void pair_up() {
    std::vector<std::pair<Node, std::uint32_t>> meets;  // node, edge
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      for (const Node n : edges_[e].ends) meets.emplace_back(n, e);
    std::sort(meets.begin(), meets.end());
    for (std::size_t first = 0, last; first < meets.size(); first = last) {
      const Node n = meets[first].first;
      for (last = first; last < meets.size() && meets[last].first == n;) ++last;
      if (last - first > kMostMeeting) continue;
      for (std::size_t i = first; i < last; ++i) {
        for (std::size_t j = i + 1; j < last; ++j) {
          Edge &a = edges_[meets[i].second], &b = edges_[meets[j].second];
          std::uint32_t &after_a = a.next[end_of(meets[i].second, n)], &after_b = b.next[end_of(meets[j].second, n)];
          if (after_a != kNobody || after_b != kNobody || !straight(a.other(n), n, b.other(n))) continue;
          after_a = meets[j].second;
          after_b = meets[i].second;
        }
      }
    }
  }

  /// b lies between a and c and near the line through them.
  [[nodiscard]] bool straight(Node a, Node b, Node c) const {
    const Point in = at(b) - at(a), out = at(c) - at(b), all = at(c) - at(a);
    if (!(dot(in, out) > 0)) return false;
    const double off = cross(all, in);
    return off * off <= tolerance_ * tolerance_ * dot(all, all);
  }

  void follow(std::uint32_t edge, Node from) {
    std::vector<Node> chain{from};
    while (edge != kNobody && !edges_[edge].used) {
      edges_[edge].used = true;
      chain.push_back(edges_[edge].other(chain.back()));
      edge = edges_[edge].next[end_of(edge, chain.back())];
    }
    for (std::size_t i = 0; i + 1 < chain.size();) {
      const std::size_t to = grow(chain, i);
      found_.emplace_back(std::min(chain[i], chain[to]), std::max(chain[i], chain[to]));
      i = to;
    }
  }

  /// The farthest node of the chain to which one piece may go from node i.
  [[nodiscard]] std::size_t grow(const std::vector<Node>& chain, std::size_t i) const {
    const Point origin = at(chain[i]);
    bool has_cone = false;
    Point right{}, left{};  // the limits of the directions that pass near all nodes so far
    std::size_t good = i + 1;
    for (std::size_t k = i + 1; k < chain.size(); ++k) {
      const Point d = at(chain[k]) - origin;
      if (has_cone && !(cross(right, d) >= 0 && cross(d, left) >= 0)) break;
      if (k > i + 1 && !(dot(d, at(chain[k]) - at(chain[k - 1])) > 0)) break;
      good = k;
      const double square = dot(d, d), reach = square - tolerance_ * tolerance_;
      if (!(reach > 0)) continue;  // every direction passes near it
      // Tangents from the origin to the disc around the node.
      const double c = std::sqrt(reach), t = tolerance_;
      const Point to_left{d.x_m * c - d.y_m * t, d.x_m * t + d.y_m * c},
          to_right{d.x_m * c + d.y_m * t, d.y_m * c - d.x_m * t};
      if (!has_cone || cross(to_left, left) > 0) left = to_left;
      if (!has_cone || cross(right, to_right) > 0) right = to_right;
      has_cone = true;
    }
    return good;
  }

  double tolerance_;
  Nodes nodes_;
  std::vector<Edge> edges_;
  std::vector<std::pair<Node, Node>> found_;
};

}  // namespace

std::vector<LinePiece> join(const std::vector<LinePiece>& pieces, double tolerance) {
  return Joiner(pieces, tolerance).join();
}

}  // namespace evigrid::scenes
