// SPDX-License-Identifier: Apache-2.0
// A* over large grids: corner to corner of 4096 × 4096 cells, open, through rooms with doors, among random blocks, and
// over costs that vary; beside it, where Boost is installed, Boost.Graph's astar_search over the same grid with its
// vectors kept between searches. Both find ways of the same cost (checked). Counters: expanded cells, and those per
// second. And the exact distance transform of the same grids.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "navigate/astar.hpp"
#include "navigate/distance_transform.hpp"
#ifdef EVIGRID_BENCH_BOOST
#include <boost/graph/astar_search.hpp>
#include <boost/graph/graph_concepts.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/function_property_map.hpp>
#endif

namespace {

using namespace evigrid::driver;

/// Rooms of 80 cells, walls of 3, a door of 20 in each wall.
CostGrid rooms(int side) {
  CostGrid grid(side, side);
  constexpr int room = 80, wall = 3, door = 20;
  for (int line = room; line + room <= side; line += room)
    for (int along = 0; along < side; ++along) {
      const int at = along % room, from = 10 + (line / room * 7 + along / room * 13) % 40;
      if (at >= from && at < from + door) continue;
      for (int k = 0; k < wall; ++k)
        grid.cost[grid.index({line + k, along})] = grid.cost[grid.index({along, line + k})] = kBlocked;
    }
  return grid;
}

CostGrid random_blocks(int side) {
  CostGrid grid(side, side);
  std::mt19937 random(5);
  for (float& c : grid.cost)
    if (random() % 10 < 2) c = kBlocked;
  return grid;
}

/// Smooth hills between 1 and 11, as an occupancy map's costs.
CostGrid hills(int side) {
  CostGrid grid(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      grid.cost[grid.index({x, y})] = static_cast<float>(1 + 5 * (1 + std::sin(x * 0.02) * std::cos(y * 0.013)));
  return grid;
}

const CostGrid& grid_of(const std::string& kind, int side) {
  static std::map<std::string, CostGrid> kept;
  const std::string key = kind + std::to_string(side);
  if (auto it = kept.find(key); it != kept.end()) return it->second;
  kept.clear();
  CostGrid grid = kind == "rooms"    ? rooms(side)
                  : kind == "random" ? random_blocks(side)
                  : kind == "hills"  ? hills(side)
                                     : CostGrid(side, side);
  grid.cost[grid.index({1, 1})] = grid.cost[grid.index({side - 2, side - 2})] = 1;
  return kept[key] = std::move(grid);
}

void count(benchmark::State& state, std::size_t expanded, double cost) {
  state.counters["expanded"] = static_cast<double>(expanded);
  state.counters["expanded/s"] =
      benchmark::Counter(static_cast<double>(expanded), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["cost"] = cost;
}

void ours(benchmark::State& state, const std::string& kind, int side) {
  const CostGrid& grid = grid_of(kind, side);
  Planner planner;
  GridPath path = planner.find(grid, {1, 1}, {side - 2, side - 2});  // the first one also gets the memory
  for (auto _ : state) path = planner.find(grid, {1, 1}, {side - 2, side - 2});
  if (!path.found()) return state.SkipWithError("no way");
  count(state, path.expanded, path.cost);
}

/// A way of 40 cells in the middle: what a large grid costs a short search.
void ours_short(benchmark::State& state, int side) {
  const CostGrid& grid = grid_of("open", side);
  Planner planner;
  const int m = side / 2;
  GridPath path = planner.find(grid, {m, m}, {m + 40, m + 13});
  for (auto _ : state) path = planner.find(grid, {m, m}, {m + 40, m + 13});
  count(state, path.expanded, path.cost);
}

void transform(benchmark::State& state, const std::string& kind, int side) {
  const CostGrid& grid = grid_of(kind, side);
  std::vector<std::uint8_t> marked(grid.cost.size());
  for (std::size_t i = 0; i < marked.size(); ++i) marked[i] = grid.cost[i] == kBlocked;
  for (auto _ : state) benchmark::DoNotOptimize(squared_distances(marked, side, side));
  state.counters["cells/s"] =
      benchmark::Counter(static_cast<double>(marked.size()), benchmark::Counter::kIsIterationInvariantRate);
}

#ifdef EVIGRID_BENCH_BOOST
/// The same moves as an implicit graph: eight neighbours, no squeezing between corners.
struct GridGraph {
  const CostGrid* grid;
};
struct GridEdge {
  std::size_t from, to;
  friend bool operator==(const GridEdge&, const GridEdge&) = default;
};
class OutEdges : public boost::iterator_facade<OutEdges, GridEdge, boost::forward_traversal_tag, GridEdge> {
 public:
  OutEdges() = default;
  OutEdges(const CostGrid* grid, std::size_t from, int d) : grid_(grid), from_(from), d_(d) { skip(); }

 private:
  friend class boost::iterator_core_access;
  static constexpr int kX[8] = {1, 0, -1, 0, 1, -1, -1, 1}, kY[8] = {0, 1, 0, -1, 1, 1, -1, -1};
  [[nodiscard]] bool open() const {
    const GridCell at = grid_->cell(from_), to{at.x + kX[d_], at.y + kY[d_]};
    return grid_->free(to) && (d_ < 4 || (grid_->free({at.x, to.y}) && grid_->free({to.x, at.y})));
  }
  void skip() {
    while (d_ < 8 && !open()) ++d_;
  }
  void increment() {
    ++d_;
    skip();
  }
  [[nodiscard]] bool equal(const OutEdges& o) const { return d_ == o.d_; }
  [[nodiscard]] GridEdge dereference() const {
    const GridCell at = grid_->cell(from_);
    return {from_, grid_->index({at.x + kX[d_], at.y + kY[d_]})};
  }
  const CostGrid* grid_ = nullptr;
  std::size_t from_ = 0;
  int d_ = 8;
};
#endif

}  // namespace

#ifdef EVIGRID_BENCH_BOOST
namespace boost {
template <>
struct graph_traits<GridGraph> {
  using vertex_descriptor = std::size_t;
  using edge_descriptor = GridEdge;
  using directed_category = directed_tag;
  using edge_parallel_category = disallow_parallel_edge_tag;
  struct traversal_category : incidence_graph_tag, vertex_list_graph_tag {};
  using out_edge_iterator = OutEdges;
  using degree_size_type = int;
  using vertex_iterator = counting_iterator<std::size_t>;
  using vertices_size_type = std::size_t;
  static vertex_descriptor null_vertex() { return SIZE_MAX; }
};
}  // namespace boost

namespace {

std::pair<OutEdges, OutEdges> out_edges(std::size_t v, const GridGraph& g) { return {{g.grid, v, 0}, {g.grid, v, 8}}; }
int out_degree(std::size_t v, const GridGraph& g) {
  return static_cast<int>(std::distance(out_edges(v, g).first, out_edges(v, g).second));
}
std::size_t source(const GridEdge& e, const GridGraph&) { return e.from; }
std::size_t target(const GridEdge& e, const GridGraph&) { return e.to; }
std::pair<boost::counting_iterator<std::size_t>, boost::counting_iterator<std::size_t>> vertices(const GridGraph& g) {
  return {boost::counting_iterator<std::size_t>(0), boost::counting_iterator<std::size_t>(g.grid->cost.size())};
}
[[maybe_unused]] std::size_t num_vertices(const GridGraph& g) { return g.grid->cost.size(); }

struct Reached {};
struct Goal : boost::default_astar_visitor {
  Goal(std::size_t g, std::size_t* n) : goal(g), expanded(n) {}
  template <class G>
  void examine_vertex(std::size_t v, const G&) {
    ++*expanded;
    if (v == goal) throw Reached{};
  }
  std::size_t goal;
  std::size_t* expanded;
};

void boost_graph(benchmark::State& state, const std::string& kind, int side) {
  const CostGrid& grid = grid_of(kind, side);
  const GridGraph graph{&grid};
  const std::size_t n = grid.cost.size(), start = grid.index({1, 1}), goal = grid.index({side - 2, side - 2});
  std::vector<double> distance(n), rank(n);
  std::vector<std::size_t> predecessor(n);
  std::vector<boost::default_color_type> colour(n);
  const boost::identity_property_map index;
  const auto heuristic = [&](std::size_t v) {
    const GridCell a = grid.cell(v), b = grid.cell(goal);
    const int dx = std::abs(a.x - b.x), dy = std::abs(a.y - b.y);
    return std::max(dx, dy) + (std::numbers::sqrt2 - 1) * std::min(dx, dy);
  };
  const auto weight = boost::make_function_property_map<GridEdge>([&](const GridEdge& e) {
    const GridCell a = grid.cell(e.from), b = grid.cell(e.to);
    return (a.x != b.x && a.y != b.y ? std::numbers::sqrt2 : 1.0) * static_cast<double>(grid.cost[e.to]);
  });
  std::size_t expanded = 0;
  for (auto _ : state) {
    expanded = 0;
    try {
      boost::astar_search(graph, start, heuristic, Goal(goal, &expanded),
                          boost::make_iterator_property_map(predecessor.begin(), index),
                          boost::make_iterator_property_map(rank.begin(), index),
                          boost::make_iterator_property_map(distance.begin(), index), weight, index,
                          boost::make_iterator_property_map(colour.begin(), index), std::less<double>(),
                          boost::closed_plus<double>(), std::numeric_limits<double>::max(), 0.0);
    } catch (const Reached&) {
    }
  }
  const GridPath check = Planner().find(grid, {1, 1}, {side - 2, side - 2});
  if (std::abs(check.cost - distance[goal]) > 1e-6 * check.cost) return state.SkipWithError("another cost than ours");
  count(state, expanded, distance[goal]);
}

}  // namespace
#endif

int register_all() {
  for (const char* kind : {"open", "rooms", "random", "hills"}) {
    const std::string name(kind);
    benchmark::RegisterBenchmark(("astar/ours/" + name + "/side:4096").c_str(), [name](benchmark::State& s) {
      ours(s, name, 4096);
    })->Unit(benchmark::kMillisecond);
#ifdef EVIGRID_BENCH_BOOST
    benchmark::RegisterBenchmark(("astar/boost/" + name + "/side:4096").c_str(), [name](benchmark::State& s) {
      boost_graph(s, name, 4096);
    })->Unit(benchmark::kMillisecond);
#endif
  }
  for (const int side : {256, 4096}) {
    benchmark::RegisterBenchmark(("astar/ours/short/side:" + std::to_string(side)).c_str(), [side](
                                                                                                benchmark::State& s) {
      ours_short(s, side);
    })->Unit(benchmark::kMicrosecond);
  }
  benchmark::RegisterBenchmark("distance_transform/rooms/side:4096", [](benchmark::State& s) {
    transform(s, "rooms", 4096);
  })->Unit(benchmark::kMillisecond);
  return 0;
}
const int registered = register_all();
