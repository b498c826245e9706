// SPDX-License-Identifier: Apache-2.0
// The scene's own calls for cones: questions are checked, neighbourhoods are shared out over threads.
#include "evigrid/raycast/scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "caster.hpp"
#include "cone.hpp"
#include "parallel.hpp"
#include "query.hpp"

namespace evigrid::raycast {

Scene::Scene(const World& world, std::span<const World> movers, Index index) : impl_(new Impl(world, movers, index)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::size_t Scene::surface_count() const noexcept {
  std::size_t count = impl_->world.size();
  for (const auto& mover : impl_->movers) count += mover->size();
  return count;
}

Index Scene::index() const noexcept { return impl_->buckets ? Index::buckets : Index::embree; }

Echo Scene::cast_cone(const ConeQuery& q, Placements movers) const {
  check(q);
  impl_->check(movers);
  Echo echo;
  ConeCaster(*impl_, movers).cast({&q, 1}, &echo);
  return echo;
}

void Scene::cast_cones(std::span<const ConeQuery> queries, std::span<Echo> echoes, Placements movers,
                       int threads) const {
  if (queries.size() != echoes.size()) throw std::invalid_argument("cast_cones: not one echo per query");
  impl_->check(movers);
  for (const ConeQuery& q : queries) check(q);
  // Neighbourhoods stay whole whoever casts them.
  std::vector<std::size_t> begin;
  for (std::size_t i = 0; i < queries.size(); i += ConeCaster::neighbourhood(queries.subspan(i))) begin.push_back(i);
  begin.push_back(queries.size());
  const std::size_t rings = begin.size() - 1, block = std::max<std::size_t>(1, 64 * rings / (queries.size() + 1));
  for_each_block(rings, block, threads, [&](std::size_t from, std::size_t to) {
    ConeCaster(*impl_, movers).cast(queries.subspan(begin[from], begin[to] - begin[from]), &echoes[begin[from]]);
  });
}

}  // namespace evigrid::raycast
