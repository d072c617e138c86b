// What one machine of some cores holds: a simulation alone, and bots and viewers on the server's program on
// one core, give the costs; what two cores hold is computed from them, and measured.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "bench/support/machine.h"
#include "studies/scale/axes.h"
#include "studies/scale/loaded_server.h"
#include "studies/scale/machine_model.h"
#include "studies/scale/most_held.h"
#include "studies/scale/simulated_bots.h"

namespace scree {

namespace {

constexpr double agrees_within = 0.25;
constexpr double search_below = 0.7;  ///< of what the model foretells: a search begins there

struct LoadRow {
  ServerLoad load;
  ServedLoad served;
  MachineLoad size() const { return {static_cast<double>(load.bots), static_cast<double>(load.viewers)}; }
};

class MachineMeasure {
 public:
  explicit MachineMeasure(const ScaleRun& run) : run_(run), seconds_(run.quick ? 2.5 : 4.0) {}

  Result<MachineStudy> measure();

 private:
  Result<const LoadRow*> serve(size_t bots, size_t viewers, unsigned cores);
  Result<void> fit();
  Result<void> fit_costs(const std::vector<const LoadRow*>& rows);
  void fit_sizes();
  Result<MostHeld> most_bots(double expected, unsigned cores);
  Result<void> check_one_core();
  Result<void> check_two_cores();
  MachineModel with_clients() const;
  MachineLimits limits(double cores) const;
  double memory_of(size_t viewers) const;
  ReportTable loads_table() const;
  ReportTable cores_table() const;
  ReportTable costs_table() const;
  ReportTable simulation_table() const;
  std::vector<std::string> terms_text() const;
  std::string left_out_text() const;
  void tell();

  const ScaleRun& run_;
  double seconds_;  ///< of a load; two statuses come in it, which tell of the ticks
  size_t served_ = 0;
  std::list<LoadRow> rows_;
  MachineModel model_;  ///< of the server alone
  LoadCosts clients_;   ///< of bots and viewers on the same machine
  double fit_error_ = 0.0;
  std::vector<std::string> left_out_;  ///< of the fit
  double usable_ = 1.0;
  size_t on_one_core_ = 0;  ///< bots that were measured to hold
  MachineStudy study_;
};

Result<const LoadRow*> MachineMeasure::serve(size_t bots, size_t viewers, unsigned cores) {
  const ServerLoad load{bots, viewers, cores, run_.quick ? 1.0 : 2.5, seconds_};
  const auto served = TRY(serve_load(load));
  run_.progress(std::min(0.98, 0.05 + 0.03 * static_cast<double>(++served_)));
  return &rows_.emplace_back(LoadRow{load, served});
}

/// Costs of light loads on one core, by processor time: that is the same when ticks are late.
Result<void> MachineMeasure::fit() {
  const std::vector<MachineLoad> loads =
      run_.quick ? std::vector<MachineLoad>{{0, 1}, {2, 0}, {0, 100}, {2, 100}}
                 : std::vector<MachineLoad>{{0, 1},   {2, 0},   {5, 0},   {9, 0},   {0, 300},
                                            {0, 900}, {2, 300}, {5, 300}, {9, 100}, {2, 900}};
  std::vector<const LoadRow*> carried_out;
  for (const MachineLoad& load : loads) {
    const auto row = TRY(serve(static_cast<size_t>(load.bots), static_cast<size_t>(load.viewers), 1));
    if (row->served.carried_out())
      carried_out.push_back(row);
    else
      left_out_.push_back(fmt::format("{:.0f} bots with {:.0f} viewers", load.bots, load.viewers));
  }
  TRY(fit_costs(carried_out));
  fit_sizes();
  return {};
}

/// The simulation's thread against the simulation alone, and all other threads by bots and onlookers.
Result<void> MachineMeasure::fit_costs(const std::vector<const LoadRow*>& rows) {
  std::vector<MeasuredLoad> server, others, clients;
  double in_server_ms_s = 0.0, alone_ms_s = 0.0;
  SimulationCosts& simulation = model_.simulation;
  for (const LoadRow* row : rows)
    if (row->load.bots == 0 && row->load.viewers == 1) simulation.idle_ms_s = row->served.simulation_ms_s;
  for (const LoadRow* row : rows) {
    const ServedLoad& served = row->served;
    server.push_back({row->size(), served.server_ms_s});
    others.push_back({row->size(), served.server_ms_s - served.simulation_ms_s});
    clients.push_back({row->size(), served.clients_ms_s});
    if (row->load.bots == 0) continue;
    in_server_ms_s += served.simulation_ms_s - simulation.idle_ms_s;
    alone_ms_s += simulation.at(row->size().bots).ms_s();
  }
  const auto costs = fit_load_costs(others), clients_costs = fit_load_costs(clients);
  if (!costs || !clients_costs || alone_ms_s <= 0.0 || in_server_ms_s <= 0.0)
    return fail(
        fmt::format("too few loads were carried out on one core to fit their costs: {}", rows.size()));
  model_.others = *costs;
  clients_ = *clients_costs;
  simulation.in_server = in_server_ms_s / alone_ms_s;
  fit_error_ = relative_error(server, [this](const MachineLoad& load) { return model_.ms_s(load); });
  return {};
}

void MachineMeasure::fit_sizes() {
  for (const auto& [load, served] : rows_)
    if (load.bots > 0 && load.viewers > 0)
      model_.sizes.kbit_s_shown =
          std::max(model_.sizes.kbit_s_shown, served.kbit_s_viewer / static_cast<double>(load.bots));
  model_.sizes.mib = memory_of(1);
  const double crowd = run_.quick ? 100.0 : 900.0;
  model_.sizes.mib_onlooker = std::max(0.0, memory_of(static_cast<size_t>(crowd)) - model_.sizes.mib) / crowd;
}

/// What the server has in RAM with so many viewers and no bots.
double MachineMeasure::memory_of(size_t viewers) const {
  for (const LoadRow& row : rows_)
    if (row.load.bots == 0 && row.load.viewers == viewers) return row.served.resident_mib;
  return 0.0;
}

MachineLimits MachineMeasure::limits(double cores) const {
  return {.cores = cores, .usable = usable_, .memory_mib = 4096.0, .mbit_s = 1000.0};
}

/// The model of a server whose clients share its processors.
MachineModel MachineMeasure::with_clients() const {
  MachineModel both = model_;
  both.others.idle += clients_.idle;
  both.others.bot += clients_.bot;
  both.others.onlooker += clients_.onlooker;
  both.others.shown += clients_.shown;
  return both;
}

/// Searched from below what is expected until a load fails, so that what is found does not depend on that.
Result<MostHeld> MachineMeasure::most_bots(double expected, unsigned cores) {
  const auto holds = [&](size_t bots) -> Result<bool> {
    const auto row = TRY(serve(bots, 0, cores));
    return row->served.holds();
  };
  const auto start = static_cast<size_t>(std::max(1L, std::lround(search_below * expected)));
  return most_held(run_.quick ? HeldSearch{.start = start, .most = start} : HeldSearch{.start = start},
                   holds);
}

/// How much of a core can be used: the most that the server took of one with a load that held.
Result<void> MachineMeasure::check_one_core() {
  const auto most = most_bots(model_.bots_held(0.0, limits(1.0)).most, 1);
  TRY(most);
  on_one_core_ = most->holds;
  double used_ms_s = 0.0;
  for (const auto& [load, served] : rows_)
    if (load.cores == 1 && served.holds()) used_ms_s = std::max(used_ms_s, served.server_ms_s);
  if (on_one_core_ > 0) usable_ = std::min(1.0, used_ms_s / 1000.0);
  study_.figures.metric("machine_bots_on_one_core", static_cast<double>(on_one_core_));
  return {};
}

Result<void> MachineMeasure::check_two_cores() {
  if (usable_cores() < 2) {
    study_.section.text.push_back("This process may use one core, so that nothing is compared with two.");
    return {};
  }
  const Held expected = with_clients().bots_held(0.0, limits(2.0));
  const auto on_two = TRY(most_bots(expected.most, 2));
  const auto shown = serve(4, run_.quick ? 100 : 600, 2);
  TRY(shown);
  const double measured_ms = (*shown)->served.server_ms_s, model_ms = model_.ms_s((*shown)->size());
  const auto bots = static_cast<double>(on_two.holds);
  study_.figures.metric("machine_bots_on_two_cores", bots);
  study_.figures.metric("machine_bots_on_two_cores_expected", expected.most);
  const auto within = [](double measured, double model) {
    return std::abs(measured / model - 1.0) <= agrees_within;
  };
  if (!run_.quick) {  // a second or two tell too little
    study_.figures.check(
        "machine_bots_on_two_cores", within(bots, expected.most),
        fmt::format("{} bots, {:.1f} by the model of one core, wanted within 25 %", bots, expected.most));
    study_.figures.check(
        "machine_load_on_two_cores", within(measured_ms, model_ms),
        fmt::format("{:.0f} ms a second, {:.0f} by the model, wanted within 25 %", measured_ms, model_ms));
  }
  const std::string fails =
      on_two.fails ? fmt::format("{} do not hold", *on_two.fails) : std::string("more were not tried");
  study_.section.text.push_back(fmt::format(
      "On one core {} bots hold. By that and the costs below two cores hold {:.1f} bots whose clients share "
      "them, and the first limit is {}; measured are **{}**, and {}. A load of 4 bots and {} viewers takes "
      "{:.0f} ms a second of two cores, by the model {:.0f} ms.",
      on_one_core_, expected.most, name_of(expected.limit), on_two.holds, fails, (*shown)->load.viewers,
      measured_ms, model_ms));
  return {};
}

ReportTable MachineMeasure::loads_table() const {
  ReportTable table{
      "Loads",
      {"cores", "bots", "viewers", "server, ms/s", "by the model, ms/s", "simulation's thread, ms/s",
       "clients, ms/s", "bots' turns a second", "carves a second", "reply, 99th percentile, ms",
       "ticks a second", "to a viewer, kbit/s", "in RAM, MiB", "holds"},
      {}};
  for (const auto& [load, served] : rows_) {
    const MachineLoad size{static_cast<double>(load.bots), static_cast<double>(load.viewers)};
    table.rows.push_back(
        {fmt::format("{}", load.cores), fmt::format("{}", load.bots), fmt::format("{}", load.viewers),
         figure(served.server_ms_s), figure(model_.ms_s(size)), figure(served.simulation_ms_s),
         figure(served.clients_ms_s), figure(served.turns_per_s), figure(served.carves_per_s),
         figure(served.reply_p99_ms), figure(served.ticks_per_s), figure(served.kbit_s_viewer),
         figure(served.resident_mib), served.holds() ? "yes" : "no"});
  }
  return table;
}

ReportTable MachineMeasure::costs_table() const {
  const auto& [idle, bot, onlooker, shown] = model_.others;
  const SimulationCosts& sim = model_.simulation;
  return {"Costs on one core",
          {"what", "the simulation's thread", "the server's other threads", "the clients"},
          {{"nobody there, ms/s", figure(sim.idle_ms_s), figure(idle), figure(clients_.idle)},
           {"a bot, ms/s", "by the curve below", figure(bot), figure(clients_.bot)},
           {"an onlooker, ms/s", "–", figure(onlooker), figure(clients_.onlooker)},
           {"a bot's doing shown to an onlooker, ms/s", "–", figure(shown), figure(clients_.shown)},
           {"memory of an onlooker, MiB", "–", figure(model_.sizes.mib_onlooker), "–"},
           {"sent to an onlooker for a bot, kbit/s", "–", figure(model_.sizes.kbit_s_shown), "–"}}};
}

ReportTable MachineMeasure::simulation_table() const {
  ReportTable table{"The simulation alone, on one thread",
                    {"bots", "all but bodies, ms/s", "bodies, ms/s", "pieces alive",
                     "its thread in a server of one core, ms/s", "of two cores, ms/s"},
                    {}};
  for (const SimulatedLoad& load : model_.simulation.loads)
    table.rows.push_back({fmt::format("{:.0f}", load.bots), figure(load.serial_ms_s),
                          figure(load.shared_ms_s), figure(load.pieces_alive),
                          figure(model_.simulation_thread_ms_s(load.bots, 1.0)),
                          figure(model_.simulation_thread_ms_s(load.bots, 2.0))});
  return table;
}

ReportTable MachineMeasure::cores_table() const {
  ReportTable table{"What a machine holds by the model, its clients elsewhere",
                    {"cores", "bots", "first limit", "viewers beside 5 bots", "first limit"},
                    {}};
  for (const double cores : {1.0, 2.0, 4.0, 8.0, 16.0}) {
    const MachineLimits of = limits(cores);
    const Held bots = model_.bots_held(0.0, of), viewers = model_.viewers_held(5.0, of);
    const auto count = [](const Held& held) { return fmt::format("{:.0f}", std::floor(held.most)); };
    table.rows.push_back({fmt::format("{:.0f}", cores), count(bots), std::string(name_of(bots.limit)),
                          count(viewers), std::string(name_of(viewers.limit))});
  }
  return table;
}

/// What the model says, and from where each of its terms is known.
std::vector<std::string> MachineMeasure::terms_text() const {
  const SimulationCosts& sim = model_.simulation;
  return {
      fmt::format(
          "The model has five limits, and the first that a load meets counts. (1) **The tick's budget**: the "
          "simulation itself carries out the turns of {:.0f} bots in time, by the same measure, and of no "
          "more, on any machine: its budget counts work and no time. That is found by simulating bots "
          "without a server. Below it the budget is no wall: carves get fewer pieces and these merge sooner, "
          "so that a bot costs less the more there are. (2) **The processors' time**: what all threads take "
          "is at most {:.0f} % of all cores. So much a server took at most of one core that held its "
          "load. (3) **The simulation's thread**: what it does alone, and its part of the bodies, which all "
          "cores share, is at most the same share of one core. (4) **Memory** of 4 GiB and (5) **bandwidth** "
          "of 1 Gbit/s.",
          sim.bots_most, 100.0 * usable_),
      fmt::format(
          "The simulation's thread takes {:.2f} times in a server what the simulation takes alone, by the "
          "thread's processor time over all light loads: it also saves and hands over the ticks, and shares "
          "its core's caches. The other threads' costs are fitted to the light loads on one core, first in "
          "the "
          "table of loads; with the simulation's, the model is off by {:.0f} % there (root mean square). {}",
          sim.in_server, 100.0 * fit_error_, left_out_text())};
}

std::string MachineMeasure::left_out_text() const {
  const std::string rule =
      "A load was not carried out if it had fewer than 59 ticks a second, refused carves, lost connections, "
      "or carves in fewer than 90 of 100 turns. Its processor time is that of less work, so the fit leaves "
      "it out. ";
  if (left_out_.empty()) return rule + "No load was left out.";
  return rule + fmt::format("Left out: {}.", fmt::join(left_out_, ", "));
}

void MachineMeasure::tell() {
  ReportSection& section = study_.section;
  section.title = "What one machine holds";
  section.text.insert(
      section.text.begin(),
      fmt::format("A bot's turn to strike comes once a second, {:.1f} m into {} pieces, {:.0f} m apart, each "
                  "within 6 m of its place, and "
                  "look on within {:.0f} m; viewers look on from the middle. The server is "
                  "its program, with a file that "
                  "keeps its world, on as many cores as the table says; its clients are on "
                  "the other core, or share both. "
                  "A bot whose last carve is not answered misses its turn. "
                  "A load holds when 99 of 100 carves are answered within a second, "
                  "none is refused, no connection "
                  "ends, at least 59 of 60 ticks a second come, and in 95 of 100 turns a "
                  "carve is carried out. A carve that is not answered a second after the "
                  "measured ones counts as answered after {:.0f} s. Processor times are "
                  "milliseconds a second, over {:.1f} s.",
                  bot_radius_m, bot_seeds, bots_apart_m, bot_interest_m, 1e-3 * unanswered_ms, seconds_));
  const std::vector<std::string> terms = terms_text();
  section.text.insert(section.text.begin() + 1, terms.begin(), terms.end());
  section.tables = {cores_table(), costs_table(), simulation_table(), loads_table()};
}

Result<MachineStudy> MachineMeasure::measure() {
  SimulationCosts simulation = TRY(measure_simulation(run_.quick));
  model_.simulation = std::move(simulation);
  for (const auto step :
       {&MachineMeasure::fit, &MachineMeasure::check_one_core, &MachineMeasure::check_two_cores})
    TRY((this->*step)());
  tell();
  const LoadCosts& others = model_.others;
  study_.figures.metric("machine_bots_simulated", model_.simulation.bots_most);
  study_.figures.metric("machine_simulation_in_server_ratio", model_.simulation.in_server);
  study_.figures.metric("machine_idle_ms_s", others.idle + model_.simulation.idle_ms_s);
  study_.figures.metric("machine_bot_ms_s", model_.ms_s({1.0, 0.0}) - model_.ms_s({0.0, 0.0}));
  study_.figures.metric("machine_onlooker_ms_s", others.onlooker);
  study_.figures.metric("machine_shown_ms_s", others.shown);
  study_.figures.metric("machine_usable_percent", 100.0 * usable_);
  study_.figures.metric("machine_fit_error_percent", 100.0 * fit_error_);
  return std::move(study_);
}

}  // namespace

Result<MachineStudy> measure_machine(const ScaleRun& run) {
  return MachineMeasure(run).measure();
}

}  // namespace scree
