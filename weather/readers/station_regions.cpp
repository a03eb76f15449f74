#include "weather/readers/station_regions.h"

#include <array>

namespace petrichor::weather {

namespace {

struct Letters {
    std::string_view first;
    StationRegion region;
};

// Longer letters stand before shorter ones.
constexpr auto kRegions = std::to_array<Letters>({
    {"BG", {"Greenland", 65, -45}},
    {"BI", {"Iceland", 65, -19}},
    {"EB", {"Belgium", 51, 4}},
    {"ED", {"Germany", 51, 10}},
    {"EE", {"Estonia", 59, 25}},
    {"EF", {"Finland", 62, 25}},
    {"EG", {"the United Kingdom", 53, -2}},
    {"EH", {"the Netherlands", 52, 5}},
    {"EI", {"Ireland", 53, -8}},
    {"EK", {"Denmark", 56, 10}},
    {"EN", {"Norway", 62, 10}},
    {"EP", {"Poland", 52, 19}},
    {"ES", {"Sweden", 60, 16}},
    {"ET", {"Germany", 51, 10}},
    {"EV", {"Latvia", 57, 25}},
    {"EY", {"Lithuania", 55, 24}},
    {"FA", {"South Africa", -29, 25}},
    {"HE", {"Egypt", 28, 31}},
    {"HK", {"Kenya", 0, 37}},
    {"LB", {"Bulgaria", 43, 25}},
    {"LE", {"Spain", 40, -4}},
    {"LF", {"France", 47, 2}},
    {"LG", {"Greece", 38, 24}},
    {"LH", {"Hungary", 47, 19}},
    {"LI", {"Italy", 43, 12}},
    {"LK", {"Czechia", 50, 15}},
    {"LL", {"Israel", 32, 35}},
    {"LO", {"Austria", 47, 14}},
    {"LP", {"Portugal", 39, -9}},
    {"LR", {"Romania", 45, 25}},
    {"LS", {"Switzerland", 47, 8}},
    {"LT", {"Turkey", 39, 34}},
    {"LZ", {"Slovakia", 49, 19}},
    {"MM", {"Mexico", 22, -101}},
    {"NZ", {"New Zealand", -41, 173}},
    {"OE", {"Saudi Arabia", 24, 45}},
    {"OM", {"the Emirates", 24, 55}},
    {"PA", {"Alaska", 62, -150}},
    {"PH", {"Hawaii", 21, -157}},
    {"RC", {"Taiwan", 24, 121}},
    {"RJ", {"Japan", 36, 138}},
    {"RK", {"Korea", 36, 128}},
    {"RO", {"the Ryukyu Islands", 26, 128}},
    {"RP", {"the Philippines", 13, 122}},
    {"SA", {"Argentina", -35, -63}},
    {"SB", {"Brazil", -15, -48}},
    {"SC", {"Chile", -33, -71}},
    {"SK", {"Colombia", 5, -74}},
    {"SP", {"Peru", -10, -76}},
    {"TJ", {"Puerto Rico", 18, -66}},
    {"UK", {"Ukraine", 49, 31}},
    {"UU", {"the Moscow region", 56, 38}},
    {"VH", {"Hong Kong", 22, 114}},
    {"VT", {"Thailand", 15, 101}},
    {"WA", {"Indonesia", -4, 118}},
    {"WI", {"Indonesia", -4, 107}},
    {"WM", {"Malaysia", 4, 102}},
    {"WS", {"Singapore", 1, 104}},
    {"ZM", {"Mongolia", 47, 106}},
    {"C", {"Canada", 51, -95}},
    {"K", {"the contiguous United States", 39, -95}},
    {"U", {"northern Asia", 57, 75}},
    {"V", {"India and its neighbours", 21, 80}},
    {"Y", {"Australia", -28, 138}},
    {"Z", {"China", 34, 110}},
});

}  // namespace

std::optional<StationRegion> region_of_station(std::string_view station)
{
    for (const Letters& letters : kRegions) {
        if (station.size() == 4 && station.starts_with(letters.first)) return letters.region;
    }
    return std::nullopt;
}

}  // namespace petrichor::weather
