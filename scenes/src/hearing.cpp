// SPDX-License-Identifier: Apache-2.0
#include "hearing.hpp"

namespace evigrid::scenes {
namespace {

void add_cross_talk(const raycast::Scene& caster, const std::vector<SonarSpec>& sonars,
                    std::span<const raycast::ConeQuery> cones, std::span<raycast::Echo> echoes,
                    raycast::Scene::Placements movers) {
  for (std::size_t listener = 0; listener < sonars.size(); ++listener) {
    for (std::size_t speaker = 0; speaker < sonars.size(); ++speaker) {
      if (speaker == listener || sonars[speaker].group != sonars[listener].group) continue;
      const raycast::Echo heard = caster.cross_talk(cones[speaker], cones[listener], movers);
      // The first sound to arrive stops the clock.
      if (heard.status != raycast::EchoStatus::none && heard.range_m < echoes[listener].range_m)
        echoes[listener] = heard;
    }
  }
}

}  // namespace

void hear(const raycast::Scene& caster, const Scene& scene, std::span<const raycast::ConeQuery> cones,
          std::span<raycast::Echo> echoes, raycast::Scene::Placements movers) {
  if (scene.echo.second_bounce) {
    for (std::size_t i = 0; i < cones.size(); ++i) echoes[i] = caster.cast_cone_second_bounce(cones[i], movers);
  } else {
    caster.cast_cones(cones, echoes, movers);
  }
  if (!scene.echo.cross_talk) return;
  const std::size_t sonars = scene.sonars.size();
  for (std::size_t at = 0; at + sonars <= cones.size() && sonars > 0; at += sonars)
    add_cross_talk(caster, scene.sonars, cones.subspan(at, sonars), echoes.subspan(at, sonars), movers);
}

}  // namespace evigrid::scenes
