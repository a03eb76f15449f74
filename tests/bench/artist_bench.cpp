// How long the artist model takes: build/release/tests/bench/artist_bench
#include <benchmark/benchmark.h>

#include "weather/artist/exact.h"

namespace petrichor::weather {
namespace {

std::uint64_t scramble(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

double unit(std::uint64_t x)
{
    return static_cast<double>(scramble(x) >> 11) * 0x1p-53;
}

// `keys` keys ten seconds apart, every third of them dry.
Timeline script(std::int64_t keys, Interpolation interpolation)
{
    Timeline timeline;
    for (std::int64_t i = 0; i < keys; ++i) {
        const auto n = static_cast<std::uint64_t>(i);
        timeline.temperature_c.times.push_back(i * 10000000);
        timeline.temperature_c.values.push_back(60.0 * unit(2 * n) - 30.0);
        timeline.rainfall.times.push_back(i * 10000000);
        timeline.rainfall.values.push_back(i % 3 == 0 ? 0.0 : unit(2 * n + 1));
    }
    timeline.temperature_c.interpolation = timeline.rainfall.interpolation = interpolation;
    return timeline;
}

// Any time, in random order, of 1000 segments.
void seek(benchmark::State& state)
{
    const auto kind = static_cast<Interpolation>(state.range(0));
    const ArtistTimeline weather(script(1000, kind), {}, {});
    std::uint64_t n = 0;
    for (auto _ : state) {
        const auto time = static_cast<TimeUs>(scramble(++n) % 10000000000ull);
        benchmark::DoNotOptimize(weather.state_at(time));
    }
    state.SetLabel(std::string(name_of(kind)));
}
BENCHMARK(seek)->Arg(0)->Arg(1)->Arg(2);

void solve_1000_segments(benchmark::State& state)
{
    const auto kind = static_cast<Interpolation>(state.range(0));
    const Timeline timeline = script(1000, kind);
    for (auto _ : state) benchmark::DoNotOptimize(ArtistTimeline(timeline, {}, {}));
    state.SetLabel(std::string(name_of(kind)));
}
BENCHMARK(solve_1000_segments)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void one_step(benchmark::State& state)
{
    ArtistState now;
    const ArtistParams params;
    for (auto _ : state) benchmark::DoNotOptimize(now = step(now, params, 5.0, 0.4, 1.0 / 60.0));
}
BENCHMARK(one_step);

}  // namespace
}  // namespace petrichor::weather

BENCHMARK_MAIN();
