#include "weather/forcing/read_report.h"

#include <cstdio>

namespace petrichor::weather {

namespace {

std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        const auto u = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (u < 0x20 || u >= 0x7f) {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", u);
            out += code;
        } else {
            out += c;
        }
    }
    return out + "\"";
}

const char* kind_name(ReadNote::Kind kind)
{
    switch (kind) {
        case ReadNote::Kind::Filled:
            return "filled";
        case ReadNote::Kind::OutOfRange:
            return "out of range";
        case ReadNote::Kind::BadRow:
            return "bad row";
        case ReadNote::Kind::Time:
            return "time";
        case ReadNote::Kind::Warning:
            return "warning";
        case ReadNote::Kind::Info:
            break;
    }
    return "info";
}

}  // namespace

void ReadReport::add(ReadNote note)
{
    if (notes.size() < kMostNotes)
        notes.push_back(std::move(note));
    else
        ++notes_dropped;
}

FieldReport& field_report(ReadReport& report, const std::string& name)
{
    for (FieldReport& f : report.fields) {
        if (f.name == name) return f;
    }
    report.fields.push_back({});
    report.fields.back().name = name;
    return report.fields.back();
}

void note_filled(ReadReport& report, const std::string& field, std::size_t count,
                 const std::string& how)
{
    if (count == 0) return;
    FieldReport& f = field_report(report, field);
    f.filled += count;
    const std::string rows = std::to_string(count);
    if (!f.filled_by.empty()) f.filled_by += "; ";
    f.filled_by.append(how).append(" (").append(rows).append(" rows)");
    report.add({ReadNote::Kind::Filled, 0, f.name,
                std::string(how).append(" in ").append(rows).append(" rows")});
}

std::string to_text(const ReadReport& report)
{
    std::string out = "format " + report.format + ", " + std::to_string(report.rows) + " rows";
    if (report.bad_rows) out += ", " + std::to_string(report.bad_rows) + " bad rows bridged";
    out += "\n";
    for (const FieldReport& f : report.fields) {
        out += "  " + f.name + ": " + std::to_string(f.present) + " read";
        if (f.missing) out += ", " + std::to_string(f.missing) + " missing";
        if (f.missing && f.first_missing_line)
            out += " (first in line " + std::to_string(f.first_missing_line) + ")";
        if (f.out_of_range) out += ", " + std::to_string(f.out_of_range) + " out of range";
        if (!f.filled_by.empty()) out += "; filled: " + f.filled_by;
        out += "\n";
    }
    for (const ReadNote& n : report.notes) {
        if (n.kind == ReadNote::Kind::Filled) continue;
        out += std::string("  ") + kind_name(n.kind);
        if (n.line) out += " line " + std::to_string(n.line);
        if (!n.field.empty()) out += " " + n.field;
        out += ": " + n.text + "\n";
    }
    if (report.notes_dropped) out += "  and " + std::to_string(report.notes_dropped) + " more\n";
    return out;
}

std::string to_json(const ReadReport& report)
{
    std::string out;
    const auto text = [&](const char* key, const std::string& value) {
        out.append("\"").append(key).append("\":").append(quoted(value));
    };
    const auto number = [&](const char* key, std::size_t value) {
        out.append(",\"").append(key).append("\":").append(std::to_string(value));
    };
    out.append("{");
    text("format", report.format);
    number("rows", report.rows);
    number("bad_rows", report.bad_rows);
    out.append(",\"fields\":[");
    for (const FieldReport& f : report.fields) {
        if (&f != &report.fields.front()) out.append(",");
        out.append("{");
        text("name", f.name);
        number("present", f.present);
        number("missing", f.missing);
        number("first_missing_line", f.first_missing_line);
        number("out_of_range", f.out_of_range);
        number("filled", f.filled);
        out.append(",");
        text("filled_by", f.filled_by);
        out.append("}");
    }
    out.append("],\"notes\":[");
    for (const ReadNote& n : report.notes) {
        if (&n != &report.notes.front()) out.append(",");
        out.append("{");
        text("kind", kind_name(n.kind));
        number("line", n.line);
        out.append(",");
        text("field", n.field);
        out.append(",");
        text("text", n.text);
        out.append("}");
    }
    out.append("]");
    number("notes_dropped", report.notes_dropped);
    return out.append("}");
}

}  // namespace petrichor::weather
