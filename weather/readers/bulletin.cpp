#include "weather/readers/bulletin.h"

#include <algorithm>

#include "weather/readers/metar_groups.h"
#include "weather/readers/report_lines.h"
#include "weather/readers/text.h"

namespace petrichor::weather {

namespace {

bool is_code(std::string_view w)
{
    if (w.size() != 4 || w[0] < 'A' || w[0] > 'Z') return false;
    return std::all_of(w.begin(), w.end(),
                       [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); });
}

// Has the shape of a time; whether it exists is for the parser to say, with the line.
bool is_time_like(std::string_view w)
{
    return w.size() == 7 && w[6] == 'Z' && all_digits(w.substr(0, 6));
}

// Collects tokens into reports; a report ends at = or where the next begins.
class Assembler {
public:
    Assembler(Bulletin& bulletin, RowCollector& rows) : bulletin_(bulletin), rows_(rows) {}

    void line(std::string_view text, std::size_t number)
    {
        const auto w = words(text, 400);
        for (std::size_t i = 0; i < w.size(); ++i) {
            const auto t = w[i];
            if (t == "METAR" || t == "SPECI" || t == "TAF") {
                flush();
                open(t == "TAF", number);
                continue;
            }
            if (t.size() == 12 && all_digits(t)) {  // YYYYMMDDhhmm before the report
                flush();
                stamp_ = std::string(t);
                continue;
            }
            const bool starts = is_code(t) && i + 1 < w.size() &&
                                (is_time_like(w[i + 1]) || w[i + 1].substr(0, 3) == "NIL");
            if (starts && !text_.empty() && !(taf_ && only_marks())) flush();
            if (starts && !open_) open(false, number);
            if (!open_) {
                if (!is_heading(w)) continue;
                break;
            }
            if (text_.size() > 4000) flush();
            if (!text_.empty()) text_ += ' ';
            text_ += t;
            if (t.back() == '=') flush();
        }
    }
    void stamp(const std::string& digits)
    {
        flush();
        stamp_ = digits;
    }
    void flush()
    {
        if (open_ && !text_.empty()) finish();
        text_.clear();
        open_ = false;
        taf_ = false;
    }

private:
    bool only_marks() const { return text_ == "AMD" || text_ == "COR"; }
    static bool is_heading(const std::vector<std::string_view>& w)
    {
        return w.size() == 3 && w[0].size() == 6;
    }
    void open(bool taf, std::size_t number)
    {
        open_ = true;
        taf_ = taf;
        line_ = number;
        text_.clear();
    }
    // The stamp may be in local time: around the turn of a month the report's own day decides.
    void take_stamp(long long& year, int& month, int day)
    {
        if (stamp_.size() != 12) return;
        const std::string_view stamp = stamp_;
        year = *to_integer(stamp.substr(0, 4));
        month = static_cast<int>(*to_integer(stamp.substr(4, 2)));
        const int ahead = day - static_cast<int>(*to_integer(stamp.substr(6, 2)));
        if (ahead < -20) {
            month = month % 12 + 1;
            year += month == 1;
        } else if (ahead > 20) {
            month = (month + 10) % 12 + 1;
            year -= month == 12;
        }
        stamp_.clear();
    }
    void finish()
    {
        std::string_view text = text_;
        if (text.substr(0, 4) == "COR ") text.remove_prefix(4);
        if (taf_) {
            if (auto taf = parse_taf(text)) {
                taf->line = line_;
                take_stamp(taf->year, taf->month,
                           taf->issued.day ? taf->issued.day : taf->begin.day);
                bulletin_.forecasts.push_back(std::move(*taf));
                return;
            }
        } else if (auto report = parse_metar(text)) {
            report->line = line_;
            take_stamp(report->year, report->month, report->day);
            bulletin_.reports.push_back(std::move(*report));
            return;
        }
        rows_.bad_row(line_, "", "'" + shown(text) + "' is not a report");
    }

    Bulletin& bulletin_;
    RowCollector& rows_;
    std::string text_, stamp_;
    std::size_t line_ = 0;
    bool open_ = false, taf_ = false;
};

}  // namespace

Bulletin read_bulletin(std::string_view text, RowCollector& rows)
{
    Bulletin bulletin;
    Assembler assembler(bulletin, rows);
    const ReportLines wrapping(text.substr(0, 1 << 16));
    Lines lines(text);
    while (const auto line = lines.next()) {
        const DatedText part = wrapping.of(*line);
        if (!part.stamp.empty()) assembler.stamp(part.stamp);
        std::string clean(part.text);
        for (char& c : clean) {
            if (static_cast<unsigned char>(c) < 0x20) c = ' ';
        }
        assembler.line(clean, lines.number());
        if (part.whole) assembler.flush();
    }
    assembler.flush();
    return bulletin;
}

}  // namespace petrichor::weather
