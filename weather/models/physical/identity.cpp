#include "weather/models/physical/identity.h"

#include "weather/models/physical/detail/parameter_hash.h"

namespace petrichor::weather {

namespace {

RunIdentity identity_without_ground(const ForcingTable& table, const PhysicalParams& params)
{
    detail::ParameterHash weather, model;
    weather.add(table);
    model.add_model(params);
    return {weather.value(), 0, model.value()};
}

}  // namespace

RunIdentity cell_identity(const ForcingTable& table, const PhysicalParams& params)
{
    RunIdentity identity = identity_without_ground(table, params);
    detail::ParameterHash ground;
    ground.add(params.surface);
    identity.ground = ground.value();
    return identity;
}

RunIdentity grid_identity(const ForcingTable& table, const GridParams& params,
                          std::span<const GridCell> cells)
{
    RunIdentity identity = identity_without_ground(table, params.model);
    detail::ParameterHash ground;
    for (const Surface& surface : params.surfaces) ground.add(surface);
    for (const GridCell& cell : cells) ground.add(cell);
    identity.ground = ground.value();
    return identity;
}

}  // namespace petrichor::weather
