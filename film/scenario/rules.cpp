#include "film/scenario/rules.h"

#include <iterator>

#include "film/scenario/rule_tables.h"

namespace petrichor::film {

const std::vector<Rule>& rules()
{
    static const std::vector<Rule> all = [] {
        std::vector<Rule> table;
        for (const auto part : {scene_rules, camera_rules, sky_rules, weather_rules, light_rules, ground_rules, render_rules, output_rules}) {
            std::vector<Rule> rows = part();
            table.insert(table.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
        }
        return table;
    }();
    return all;
}

}  // namespace petrichor::film
