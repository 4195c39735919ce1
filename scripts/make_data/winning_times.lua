-- Makes data/winning_times: the men's 100 m at the Olympic Games, official results typed in (SOURCE.md says how).
local games = {
    -- year, time (s), timing, athlete, nation
    {1896, 12.0, "hand", "Thomas Burke", "USA"},
    {1900, 11.0, "hand", "Frank Jarvis", "USA"},
    {1904, 11.0, "hand", "Archie Hahn", "USA"},
    {1908, 10.8, "hand", "Reggie Walker", "RSA"},
    {1912, 10.8, "hand", "Ralph Craig", "USA"},
    {1920, 10.8, "hand", "Charley Paddock", "USA"},
    {1924, 10.6, "hand", "Harold Abrahams", "GBR"},
    {1928, 10.8, "hand", "Percy Williams", "CAN"},
    {1932, 10.3, "hand", "Eddie Tolan", "USA"},
    {1936, 10.3, "hand", "Jesse Owens", "USA"},
    {1948, 10.3, "hand", "Harrison Dillard", "USA"},
    {1952, 10.4, "hand", "Lindy Remigino", "USA"},
    {1956, 10.5, "hand", "Bobby Morrow", "USA"},
    {1960, 10.2, "hand", "Armin Hary", "EUA"},
    {1964, 10.0, "hand", "Bob Hayes", "USA"},
    {1968, 9.95, "auto", "Jim Hines", "USA"},
    {1972, 10.14, "auto", "Valeriy Borzov", "URS"},
    {1976, 10.06, "auto", "Hasely Crawford", "TTO"},
    {1980, 10.25, "auto", "Allan Wells", "GBR"},
    {1984, 9.99, "auto", "Carl Lewis", "USA"},
    {1988, 9.92, "auto", "Carl Lewis", "USA"},
    {1992, 9.96, "auto", "Linford Christie", "GBR"},
    {1996, 9.84, "auto", "Donovan Bailey", "CAN"},
    {2000, 9.87, "auto", "Maurice Greene", "USA"},
    {2004, 9.85, "auto", "Justin Gatlin", "USA"},
    {2008, 9.69, "auto", "Usain Bolt", "JAM"},
    {2012, 9.63, "auto", "Usain Bolt", "JAM"},
    {2016, 9.81, "auto", "Usain Bolt", "JAM"},
    {2020, 9.80, "auto", "Marcell Jacobs", "ITA"},
    {2024, 9.79, "auto", "Noah Lyles", "USA"},
}
local record = {year = {}, time = {}, timing = {}, athlete = {}, nation = {}}
for k, row in ipairs(games) do
    record.year[k], record.time[k], record.timing[k], record.athlete[k], record.nation[k] = table.unpack(row)
end
record.year, record.time = vector(record.year), vector(record.time)
save_csv("winning_times.csv", record, {units = {time = "s"}, columns = {"year", "time", "timing", "athlete", "nation"},
         title = "Winning times of the men's 100 m, Olympic Games 1896-2024"})
save_mat("winning_times.mat", record)
