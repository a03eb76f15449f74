#ifndef PETRICHOR_WEATHER_READERS_FORMATS_H
#define PETRICHOR_WEATHER_READERS_FORMATS_H

#include <string_view>

#include "weather/readers/collector.h"
#include "weather/readers/read_weather.h"

// One reader a format, each in its own file. A reader puts rows into the collector and throws Error
// only for a header that cannot be understood.
namespace petrichor::weather {

void read_fsm(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_forcing_csv(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_epw(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_tmy3(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_pvgis(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_open_meteo_json(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_open_meteo_csv(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_metar(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_smet(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_isd_lite(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_ghcn_daily(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_nsrdb(std::string_view text, RowCollector& rows, const ReadOptions& options);
void read_surfrad(std::string_view text, RowCollector& rows, const ReadOptions& options);

/// Months of a typical year come from different years; they are placed in one year without a leap
/// day.
struct TypicalYear {
    bool typical = false;
    long long year = 0;
    /// Watches year and month of every row, in order, before the rows are read.
    void watch(long long row_year, int row_month);
    /// Decides; notes it in the report.
    void decide(RowCollector& rows);
    long long of(long long row_year) const { return typical ? year : row_year; }

private:
    long long first_ = 0, last_ = 0;
    int last_month_ = 0;
};

}  // namespace petrichor::weather

#endif
