#include "cli/report/detail/stroke_font.h"

#include <array>

namespace petrichor::cli {
namespace {

// A glyph is strokes separated by ' '; a stroke is pairs of digits x y. x 0..4 (5 and 6 for wide
// letters), y 0..8 where 2 is the base line, 6 the height of small letters, 8 that of capitals.
struct Glyph {
    char character;
    double width;
    const char* strokes;
};

constexpr std::array kGlyphs{
    Glyph{'0', 4, "120307183847433212"},
    Glyph{'1', 2, "0628 2822"},
    Glyph{'2', 4, "07183847460242"},
    Glyph{'3', 4, "07183847463515 3544433212 1203"},
    Glyph{'4', 4, "38044434 3832"},
    Glyph{'5', 4, "48080525354443321203"},
    Glyph{'6', 4, "381807031232434435 350504"},
    Glyph{'7', 4, "084822"},
    Glyph{'8', 4, "15060718384746351504031232434435"},
    Glyph{'9', 4, "12324347381807061545"},
    Glyph{'A', 4, "022842 1434"},
    Glyph{'B', 4, "02083847463505 3544433202"},
    Glyph{'C', 4, "4738180703123243"},
    Glyph{'D', 4, "020828474332 3202"},
    Glyph{'E', 4, "48080242 0535"},
    Glyph{'F', 4, "480802 0535"},
    Glyph{'G', 4, "47381807031232434525"},
    Glyph{'H', 4, "0208 4248 0545"},
    Glyph{'I', 2, "1218"},
    Glyph{'J', 4, "0312323848"},
    Glyph{'K', 4, "0208 480442 0442"},
    Glyph{'L', 4, "080242"},
    Glyph{'M', 5, "020825 255852"},
    Glyph{'N', 4, "02084248"},
    Glyph{'O', 4, "1203071838474332 3212"},
    Glyph{'P', 4, "02083847463505"},
    Glyph{'Q', 4, "1203071838474332 3212 3442"},
    Glyph{'R', 4, "020838474635 3505 2542"},
    Glyph{'S', 4, "47381807061544433212 1203"},
    Glyph{'T', 4, "0848 2228"},
    Glyph{'U', 4, "080312324348"},
    Glyph{'V', 4, "082248"},
    Glyph{'W', 6, "0812365268"},
    Glyph{'X', 4, "0842 0248"},
    Glyph{'Y', 4, "082548 2522"},
    Glyph{'Z', 4, "08480242"},
    Glyph{'a', 4, "0516364542 441403123243"},
    Glyph{'b', 4, "0802 031232434536160503"},
    Glyph{'c', 3, "35261605031222 2233"},
    Glyph{'d', 4, "4842 4332120305163645"},
    Glyph{'e', 4, "044445361605031232 3243"},
    Glyph{'f', 3, "38281712 0636"},
    Glyph{'g', 4, "4641301001 4536160503123243"},
    Glyph{'h', 4, "0802 05163645 4542"},
    Glyph{'i', 1, "0206 0708"},
    Glyph{'j', 2, "161100 1718"},
    Glyph{'k', 3, "0802 360432 0432"},
    Glyph{'l', 1, "0802"},
    Glyph{'m', 5, "0602 05162522 25364552 4552"},
    Glyph{'n', 4, "0602 05163645 4542"},
    Glyph{'o', 4, "1203051636454332 3212"},
    Glyph{'p', 4, "0600 0516364543321203"},
    Glyph{'q', 4, "4640 4536160503123243"},
    Glyph{'r', 3, "0602 05163646"},
    Glyph{'s', 4, "45361605143443321203"},
    Glyph{'t', 3, "18132232 0626"},
    Glyph{'u', 4, "0603123243 4642"},
    Glyph{'v', 4, "062246"},
    Glyph{'w', 5, "0612254256"},
    Glyph{'x', 4, "0642 0246"},
    Glyph{'y', 4, "0622 461000"},
    Glyph{'z', 4, "06460242"},
    Glyph{'.', 2, "1213"},
    Glyph{',', 2, "131201"},
    Glyph{':', 2, "1213 1516"},
    Glyph{';', 2, "131201 1516"},
    Glyph{'-', 4, "1535"},
    Glyph{'+', 4, "0545 2723"},
    Glyph{'/', 4, "0148"},
    Glyph{'\\', 4, "0841"},
    Glyph{'(', 3, "29171321"},
    Glyph{')', 3, "09171301"},
    Glyph{'[', 3, "29191121"},
    Glyph{']', 3, "09191101"},
    Glyph{'_', 4, "0141"},
    Glyph{'=', 4, "0646 0444"},
    Glyph{'<', 4, "360432"},
    Glyph{'>', 4, "064402"},
    Glyph{'%', 4, "0248 0708181707 3233434232"},
    Glyph{'&', 5, "52172837041232 3254"},
    Glyph{'\'', 2, "1817"},
    Glyph{'"', 3, "0807 2827"},
    Glyph{'!', 2, "1814 1312"},
    Glyph{'?', 4, "07183847462524 2322"},
    Glyph{'#', 4, "1218 3238 0646 0444"},
    Glyph{'*', 4, "2733 2337 0545"},
    Glyph{'|', 2, "1119"},
    Glyph{'@', 5, "4324142537364453121203071848"},
    Glyph{' ', 3, ""},
    Glyph{'\x01', 3, "0718271607"},
    Glyph{'\x03', 3, "0819280525"},
};

constexpr double kGap = 1.5;

const Glyph* glyph_of(char character)
{
    for (const Glyph& glyph : kGlyphs) {
        if (glyph.character == character) return &glyph;
    }
    return nullptr;
}

// UTF-8 to the characters of the font: the degree sign is 1, superscript two 3, anything else
// beyond ASCII 2.
std::vector<char> characters_of(std::string_view utf8)
{
    std::vector<char> characters;
    for (std::size_t i = 0; i < utf8.size(); ++i) {
        const auto byte = static_cast<unsigned char>(utf8[i]);
        if (byte < 0x80) {
            characters.push_back(utf8[i]);
        } else if (byte >= 0xC0) {
            const int next =
                byte == 0xC2 && i + 1 < utf8.size() ? static_cast<unsigned char>(utf8[i + 1]) : 0;
            characters.push_back(next == 0xB0 ? '\x01' : next == 0xB2 ? '\x03' : '\x02');
        }
    }
    return characters;
}

}  // namespace

std::vector<StrokeLine> stroke_text(std::string_view utf8)
{
    std::vector<StrokeLine> lines;
    double x = 0.0;
    for (char character : characters_of(utf8)) {
        const Glyph* glyph = glyph_of(character);
        const std::string_view strokes = glyph ? glyph->strokes : "0208484202";
        StrokeLine line;
        for (std::size_t i = 0; i <= strokes.size(); ++i) {
            if (i == strokes.size() || strokes[i] == ' ') {
                if (line.size() > 1) lines.push_back(line);
                line.clear();
            } else if (i + 1 < strokes.size() && strokes[i + 1] != ' ') {
                line.emplace_back(x + (strokes[i] - '0'), strokes[i + 1] - '2');
                ++i;
            }
        }
        x += (glyph ? glyph->width : 4.0) + kGap;
    }
    return lines;
}

double stroke_text_width(std::string_view utf8)
{
    double width = 0.0;
    for (char character : characters_of(utf8)) {
        const Glyph* glyph = glyph_of(character);
        width += (glyph ? glyph->width : 4.0) + kGap;
    }
    return width > 0.0 ? width - kGap : 0.0;
}

}  // namespace petrichor::cli
