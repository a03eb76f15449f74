#ifndef PETRICHOR_WEATHER_PACKED_DETAIL_NETCDF_FILE_H
#define PETRICHOR_WEATHER_PACKED_DETAIL_NETCDF_FILE_H

#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "weather/readers/text.h"

namespace petrichor::weather::packed::detail {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::size_t kMostValues = 64u << 20;  // of one variable at once

inline void check(int status, const char* what)
{
    if (status != NC_NOERR) {
        throw Error(std::string("weather: NetCDF: ") + what + ": " + nc_strerror(status),
                    "Give a whole, undamaged file.");
    }
}

struct Dimension {
    int id = -1;
    std::string name;
    std::size_t length = 0;
};

// One open file; closes itself.
class File {
public:
    explicit File(std::span<const std::byte> bytes)
    {
        // The library does not write to memory opened for reading.
        auto* memory = const_cast<void*>(static_cast<const void*>(bytes.data()));
        check(nc_open_mem("input", NC_NOWRITE, bytes.size(), memory, &id_), "cannot be opened");
    }
    ~File() { nc_close(id_); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    int id() const { return id_; }
    std::vector<int> variables() const
    {
        int count = 0;
        check(nc_inq_nvars(id_, &count), "variables");
        std::vector<int> ids(static_cast<std::size_t>(std::clamp(count, 0, 4096)));
        for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<int>(i);
        return ids;
    }
    std::string name(int variable) const
    {
        char text[NC_MAX_NAME + 1] = {};
        check(nc_inq_varname(id_, variable, text), "name");
        return text;
    }
    std::vector<Dimension> dimensions(int variable) const
    {
        int count = 0;
        check(nc_inq_varndims(id_, variable, &count), "dimensions");
        if (count < 0 || count > 16)
            throw Error("weather: NetCDF: too many dimensions", "Reduce it.");
        std::vector<int> ids(static_cast<std::size_t>(count));
        if (count) check(nc_inq_vardimid(id_, variable, ids.data()), "dimensions");
        std::vector<Dimension> out;
        for (const int id : ids) {
            char text[NC_MAX_NAME + 1] = {};
            Dimension d{id, {}, 0};
            check(nc_inq_dim(id_, id, text, &d.length), "dimension");
            d.name = text;
            out.push_back(std::move(d));
        }
        return out;
    }
    std::string text(int variable, const char* attribute) const
    {
        nc_type type = NC_NAT;
        std::size_t length = 0;
        if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR || length > 4096)
            return {};
        if (type == NC_CHAR) {
            std::string out(length, '\0');
            if (length && nc_get_att_text(id_, variable, attribute, out.data()) != NC_NOERR)
                return {};
            while (!out.empty() && out.back() == '\0') out.pop_back();
            return out;
        }
        if (type == NC_STRING && length == 1) {
            char* string = nullptr;
            if (nc_get_att_string(id_, variable, attribute, &string) != NC_NOERR) return {};
            std::string out = string ? string : "";
            nc_free_string(1, &string);
            return out;
        }
        return {};
    }
    double number(int variable, const char* attribute, double otherwise) const
    {
        nc_type type = NC_NAT;
        std::size_t length = 0;
        double value = otherwise;
        if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR || length != 1 ||
            type == NC_CHAR || type == NC_STRING)
            return otherwise;
        return nc_get_att_double(id_, variable, attribute, &value) == NC_NOERR ? value : otherwise;
    }
    nc_type type(int variable) const
    {
        nc_type type = NC_NAT;
        check(nc_inq_vartype(id_, variable, &type), "type");
        return type;
    }
    // A box of a variable, unpacked; NaN where the file has no value.
    std::vector<double> box(int variable, const std::vector<std::size_t>& start,
                            const std::vector<std::size_t>& count) const
    {
        std::size_t total = 1;
        for (const std::size_t c : count) {
            if (c == 0 || total > kMostValues / c)
                throw Error("weather: NetCDF: '" + shown(name(variable)) + "' is too large",
                            "Cut the file into shorter periods.");
            total *= c;
        }
        std::vector<double> values(total);
        check(nc_get_vara_double(id_, variable, start.data(), count.data(), values.data()),
              name(variable).c_str());
        const double fill = number(variable, "_FillValue", kNone),
                     missing = number(variable, "missing_value", kNone),
                     scale = number(variable, "scale_factor", 1.0),
                     offset = number(variable, "add_offset", 0.0);
        for (double& v : values) {
            const bool none = v == fill || v == missing || !(std::abs(v) < 1e30);
            v = none ? kNone : v * scale + offset;
        }
        return values;
    }
    std::vector<double> whole(int variable) const
    {
        std::vector<std::size_t> start, count;
        for (const Dimension& d : dimensions(variable)) {
            start.push_back(0);
            count.push_back(d.length);
        }
        if (start.empty()) {  // a scalar
            const std::size_t zero = 0;
            double value = 0.0;
            check(nc_get_var1_double(id_, variable, &zero, &value), "scalar");
            return {value};
        }
        return box(variable, start, count);
    }

private:
    int id_ = -1;
};

}  // namespace petrichor::weather::packed::detail

#endif
