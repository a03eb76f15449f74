#include "texproc/study/protocol.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "texproc/filter/normal_codes.h"
#include "texproc/prefilter/rules.h"

namespace petrichor::texproc {

namespace {

// Texels of every level that the score will look at.
using Chosen = std::vector<std::set<std::int64_t>>;

Chosen chosen_texels(const RawImage& map, const ScoreOptions& scoring)
{
    const std::vector<LevelSize> sizes = level_sizes(map.width, map.height);
    Chosen chosen(sizes.size());
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        const auto texels = score_texels(sizes[k], static_cast<int>(k), scoring);
        chosen[k].insert(texels.begin(), texels.end());
    }
    return chosen;
}

// Mean normals rounded to the bits of the file: what eight bits alone cost.
constexpr const char* kPlainShipped = "plain as shipped";

// Files without normals beside them are read with the mean normals.
bool ships_normals(const Variant& v)
{
    return (v.options.rule == "overlap" && v.options.joint) || v.options.rule == "student-t" ||
           v.name == kPlainShipped;
}

std::vector<Prefiltered> chains_at(const ScoredMaps& maps, const std::vector<Variant>& variants,
                                   const ScoreOptions& scoring)
{
    std::vector<PrefilterOptions> some;
    for (const Variant& v : variants) {
        some.push_back(v.options);
        if (v.options.rule != "picture") some.back().design_light = scoring.light;
        some.back().threads = scoring.threads;
        some.back().bits = ships_normals(v) ? v.bits : 0;
    }
    const Chosen chosen = chosen_texels(maps.normal, scoring);
    const std::vector<LevelSize> sizes = level_sizes(maps.normal.width, maps.normal.height);
    const auto wanted = [&](int level, int x, int y) {
        const std::size_t k = static_cast<std::size_t>(level);
        return chosen[k].contains(static_cast<std::int64_t>(y) * sizes[k].width + x);
    };
    std::vector<Prefiltered> chains = prefilter_some(maps.normal, maps.roughness, some, wanted);
    for (std::size_t i = 0; i < variants.size(); ++i) {
        if (variants[i].options.rule == "lux") {
            chains[i] = prefilter_raw(maps.normal, maps.roughness, some[i]);
        }
        quantize(chains[i], variants[i].bits);
        if (!ships_normals(variants[i])) chains[i].normal.clear();
    }
    return chains;
}

void add_share(Score& sum, const Score& one, double share)
{
    if (sum.levels.empty()) {
        sum = one;
        for (LevelScore& l : sum.levels) {
            LevelScore none;
            none.level = l.level;
            l = none;
        }
    }
    for (std::size_t i = 0; i < sum.levels.size(); ++i) {
        LevelScore& to = sum.levels[i];
        const LevelScore& from = one.levels[i];
        to.plain += share * from.plain;
        to.best += share * from.best;
        to.tested += share * from.tested;
        to.energy += share * from.energy;
        to.spread += share * from.spread;
        to.reached += share * from.reached;
        to.ellipse += share * from.ellipse;
        to.codes += share * from.codes;
        to.long_codes += share * from.long_codes;
    }
}

using Bounds = std::initializer_list<std::pair<const char*, double LevelScore::*>>;

// What no rule can beat, as if it were one.
void add_bounds(std::vector<ProtocolRow>& rows, Bounds bounds)
{
    for (const auto& [name, error] : bounds) {
        rows.push_back(rows.back());
        rows.back().variant = name;
        for (LevelScore& l : rows.back().score.levels) l.tested = l.*error;
    }
}

bool square_power_of_two(const RawImage& map)
{
    return map.width == map.height && (map.width & (map.width - 1)) == 0;
}

}  // namespace

std::vector<Variant> protocol_variants(int bits)
{
    std::vector<Variant> all;
    const auto add = [&](const std::string& name, const std::string& rule) -> PrefilterOptions& {
        all.push_back({name, {}, bits});
        all.back().options.rule = rule;
        return all.back().options;
    };
    for (auto rule = rules().rbegin(); rule != rules().rend(); ++rule) {
        if (rule->kind != RuleKind::Search) add(rule->name, rule->name);
    }
    add(kPlainShipped, "none");
    add("overlap roughness only", "overlap").joint = false;
    add("overlap quick", "overlap").quick = true;
    add("overlap joint", "overlap");
    add("picture quick", "picture").quick = true;
    add("overlap anisotropic", "overlap").anisotropic = true;
    return all;
}

ProtocolOptions quick_protocol()
{
    ProtocolOptions o;
    o.seeds = 1;
    o.texels = 24;
    o.points = 512;
    return o;
}

std::vector<ProtocolRow> run_protocol(const std::vector<ScoredMaps>& materials,
                                      const std::vector<Variant>& variants,
                                      const ProtocolOptions& options)
{
    std::vector<ProtocolRow> rows;
    for (const ScoredMaps& material : materials) {
        std::vector<Variant> fitting;
        for (const Variant& v : variants) {
            if (v.options.rule != "lux" || square_power_of_two(material.normal))
                fitting.push_back(v);
        }
        for (const float light : options.lights) {
            const std::size_t first = rows.size();
            for (const Variant& v : fitting) {
                rows.push_back({material.name, v.name, light, {}});
            }
            for (int seed = 1; seed <= options.seeds; ++seed) {
                if (options.progress) {
                    options.progress(material.name + ", light " +
                                     std::to_string(light).substr(0, 3) + ", seed " +
                                     std::to_string(seed));
                }
                // An odd roll: other texels meet in every footprint.
                const int dx = (seed - 1) * 341 + 1, dy = (seed - 1) * 173 + 3;
                ScoredMaps maps{material.name, rolled(material.normal, dx, dy),
                                rolled(material.roughness, dx, dy)};
                if (options.bits == 8) {
                    maps.normal = normals_in_8_bits(std::move(maps.normal));
                    maps.roughness = in_8_bits(std::move(maps.roughness));
                }
                const ScoreOptions scoring{.light = light,
                                           .texels = options.texels,
                                           .points = options.points,
                                           .seed = static_cast<std::uint32_t>(seed),
                                           .threads = options.threads,
                                           .best_ellipse = options.best_ellipse,
                                           .best_codes = options.best_codes ? options.bits : 0};
                const std::vector<Score> scores = score_all(
                    maps.normal, maps.roughness, chains_at(maps, fitting, scoring), {}, scoring);
                for (std::size_t i = 0; i < scores.size(); ++i) {
                    add_share(rows[first + i].score, scores[i], 1.0 / options.seeds);
                }
            }
            if (fitting.empty()) continue;
            if (options.best_ellipse) {
                add_bounds(rows, {{"best ellipse, found", &LevelScore::reached},
                                  {"best ellipse, bound", &LevelScore::ellipse}});
            }
            if (options.best_codes) {
                add_bounds(rows, {{"best codes", &LevelScore::long_codes},
                                  {"best codes of any length", &LevelScore::codes}});
            }
        }
    }
    return rows;
}

std::vector<ProtocolSummary> summarize(const std::vector<ProtocolRow>& rows)
{
    std::vector<ProtocolSummary> all;
    for (const ProtocolRow& row : rows) {
        for (const bool fine : {true, false}) {
            const RangeScore range = fine ? row.score.fine() : row.score.coarse();
            if (range.levels == 0) continue;
            auto at = std::find_if(all.begin(), all.end(), [&](const ProtocolSummary& s) {
                return s.variant == row.variant && s.light == row.light && s.fine == fine;
            });
            if (at == all.end()) {
                all.push_back({});
                all.back().variant = row.variant;
                all.back().light = row.light;
                all.back().fine = fine;
                at = all.end() - 1;
            }
            at->worst_excess = std::max(at->worst_excess, range.excess());
            at->worst_over_plain = std::max(at->worst_over_plain, range.worst_over_plain);
            for (const LevelScore& l : row.score.levels) {
                const bool mine = fine == (l.level <= 5);
                if (mine && l.tested > l.plain + 0.005) ++at->levels_over_plain;
            }
            if (!range.has_room()) {
                at->worst_excess_without_room =
                    std::max(at->worst_excess_without_room, range.excess());
                continue;
            }
            if (at->with_room == 0 || range.gap() < at->worst_gap) {
                at->worst_gap = range.gap();
                at->worst_material = row.material;
            }
            ++at->with_room;
            at->mean_gap += range.gap();
            at->pooled_gap += range.plain - range.tested;
        }
    }
    for (ProtocolSummary& s : all) {
        if (!s.with_room) continue;
        s.mean_gap /= s.with_room;
        double room = 0.0;
        for (const ProtocolRow& row : rows) {
            if (row.variant != s.variant || row.light != s.light) continue;
            const RangeScore range = s.fine ? row.score.fine() : row.score.coarse();
            if (range.levels && range.has_room()) room += range.room();
        }
        s.pooled_gap *= 100.0 / room;
    }
    return all;
}

std::string to_markdown(const std::vector<ProtocolSummary>& summaries)
{
    std::vector<std::string> variants;
    std::vector<std::pair<float, bool>> columns;
    for (const ProtocolSummary& s : summaries) {
        if (std::find(variants.begin(), variants.end(), s.variant) == variants.end()) {
            variants.push_back(s.variant);
        }
        const std::pair column{s.light, s.fine};
        if (std::find(columns.begin(), columns.end(), column) == columns.end())
            columns.push_back(column);
    }
    std::string text = "| rule |", rule = "|---|";
    char cell[160];
    for (const auto& [light, fine] : columns) {
        std::snprintf(cell, sizeof cell, " %s, light %.1f |", fine ? "1-5" : "6+",
                      static_cast<double>(light));
        text += cell;
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const std::string& variant : variants) {
        text += "| " + variant + " |";
        for (const auto& [light, fine] : columns) {
            const auto s =
                std::find_if(summaries.begin(), summaries.end(),
                             [&, l = light, f = fine](const ProtocolSummary& c) {
                                 return c.variant == variant && c.light == l && c.fine == f;
                             });
            if (s == summaries.end()) {
                text += " - |";
                continue;
            }
            char excess[16] = "-";
            if (s->worst_excess_without_room > -2.0) {
                std::snprintf(excess, sizeof excess, "%+.3f", s->worst_excess_without_room);
            }
            std::snprintf(cell, sizeof cell, " %.0f / %.0f / %.0f, %s, %+.3f, %d |", s->worst_gap,
                          s->mean_gap, s->pooled_gap, excess, s->worst_over_plain,
                          s->levels_over_plain);
            text += cell;
        }
        text += "\n";
    }
    return text +
           "\nGap closed in %: worst / mean / pooled over materials with room; worst excess where "
           "there "
           "is none;\nworst level over plain; levels more than 0.005 above plain.\n";
}

std::string to_markdown_by_material(const std::vector<ProtocolRow>& rows)
{
    std::string text;
    char cell[64];
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t last = first;
        while (last < rows.size() && rows[last].material == rows[first].material &&
               rows[last].light == rows[first].light) {
            ++last;
        }
        if (first == 0) {
            text = "| material | light | levels | E plain | E best |";
            std::string rule = "|---|---|---|---|---|";
            for (std::size_t i = first; i < last; ++i) {
                text += " " + rows[i].variant + " |";
                rule += "---|";
            }
            text += "\n" + rule + "\n";
        }
        for (const bool fine : {true, false}) {
            const auto range = [&](std::size_t i) {
                return fine ? rows[i].score.fine() : rows[i].score.coarse();
            };
            if (range(first).levels == 0) continue;
            std::snprintf(cell, sizeof cell, " | %.1f | %s | %.3f | %.3f |",
                          static_cast<double>(rows[first].light), fine ? "1-5" : "6+",
                          range(first).plain, range(first).best);
            text += "| " + rows[first].material + cell;
            for (std::size_t i = first; i < last; ++i) {
                const RangeScore r = range(i);
                std::snprintf(cell, sizeof cell, r.has_room() ? " %.0f |" : " (%+.3f) |",
                              r.has_room() ? r.gap() : r.excess());
                text += cell;
            }
            text += "\n";
        }
        first = last;
    }
    return text;
}

std::string to_csv(const std::vector<ProtocolRow>& rows)
{
    std::string text = "material,rule,light,level,plain,best,error,energy\n";
    char line[96];
    for (const ProtocolRow& row : rows) {
        const auto cell = [](const std::string& name) {
            return name.find(',') == std::string::npos ? name : '"' + name + '"';
        };
        for (const LevelScore& l : row.score.levels) {
            std::snprintf(line, sizeof line, ",%.2f,%d,%.5f,%.5f,%.5f,%.5f\n",
                          static_cast<double>(row.light), l.level, l.plain, l.best, l.tested,
                          l.energy);
            text += cell(row.material) + "," + cell(row.variant) + line;
        }
    }
    return text;
}

}  // namespace petrichor::texproc
