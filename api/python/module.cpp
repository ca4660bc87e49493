// SPDX-License-Identifier: Apache-2.0
// The compiled part of the Python package navcal: the public interface of libnavcal, with samples as numpy arrays
// (docs/python.md).
#include <navcal/navcal.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <boost/preprocessor/seq/for_each.hpp>
#include <boost/preprocessor/stringize.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/python/table.h"

namespace py = pybind11;
using navcal::python::Table;
namespace api = navcal::api;

/// Attributes of a Python class that have the names of members of its type.
#define NAVCAL_READ_MEMBER(_, python_class, member) \
  python_class.def_readonly(BOOST_PP_STRINGIZE(member), &decltype(python_class)::type::member);
#define NAVCAL_READ_MEMBERS(python_class, ...) \
  BOOST_PP_SEQ_FOR_EACH(NAVCAL_READ_MEMBER, python_class, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))

/// Sets these members from keywords of the same names, as far as they were given.
#define NAVCAL_TAKE_MEMBER(_, options, member) take(keywords, BOOST_PP_STRINGIZE(member), options.member);
#define NAVCAL_TAKE_MEMBERS(options, ...) \
  BOOST_PP_SEQ_FOR_EACH(NAVCAL_TAKE_MEMBER, options, BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__))

namespace {

/// Progress of the library to a Python function (None: to nobody), and Ctrl-C to the library. The function gets
/// step and share; False ends the job, and so does what it raises. The job must run without the interpreter's
/// lock.
api::Progress relay_to(const py::object& function) {
  return [&function](std::string_view step, double share) {
    const py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (function.is_none()) return true;
    return !function(std::string(step), share).is(py::bool_(false));
  };
}

using Tables = std::map<std::string, Table>;

py::dict release(Tables& tables) {
  py::dict kinds;
  for (auto& [name, table] : tables) kinds[py::str(name)] = table.release();
  return kinds;
}

py::dict arrays_of(const std::vector<api::Sample>& samples) {
  Tables tables;
  for (const api::Sample& sample : samples) append(tables[navcal::python::name_of(sample.value)], sample);
  return release(tables);
}

/// All samples that have not been read yet.
py::dict read_arrays(api::Recording& recording, const py::object& progress) {
  constexpr std::size_t kTellEvery = 4096;
  Tables tables;
  const api::Progress tell = relay_to(progress);
  {
    const py::gil_scoped_release unlocked;
    std::size_t number = 0;
    while (const auto sample = recording.next()) {
      append(tables[navcal::python::name_of(sample->value)], *sample);
      if (++number % kTellEvery == 0 && !tell("reading", recording.progress()))
        throw api::Error(api::ErrorKind::cancelled, "cancelled by the progress callback");
    }
  }
  return release(tables);
}

py::object loads(const std::string& json) { return py::module_::import("json").attr("loads")(json); }

void bind_errors(py::module_& module) {
  static py::exception<api::Error> any(module, "Error");
  static py::exception<api::Error> bad_input(module, "BadInput", any.ptr());
  static py::exception<api::Error> bad_argument(module, "BadArgument", any.ptr());
  static py::exception<api::Error> cancelled(module, "Cancelled", any.ptr());
  any.attr("__doc__") = "Base of the module's exceptions.";
  bad_input.attr("__doc__") = "A file is missing, or is not what it should be; the text names file and place.";
  bad_argument.attr("__doc__") = "An argument cannot be used; the text names it.";
  cancelled.attr("__doc__") = "The progress function ended the work.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const api::Error& error) {
      switch (error.kind()) {
        case api::ErrorKind::bad_input: return bad_input(error.what());
        case api::ErrorKind::bad_argument: return bad_argument(error.what());
        case api::ErrorKind::cancelled: return cancelled(error.what());
        case api::ErrorKind::failed: break;
      }
      any(error.what());
    }
  });
}

void bind_samples(py::module_& module) {
  py::class_<api::Port> serial_port(module, "Port", "A serial port and its device.");
  NAVCAL_READ_MEMBERS(serial_port, name, device, baud)
  py::class_<api::Recording>(module, "Recording", "A recording (capture or log), played through the pipeline.")
      .def(py::init([](const std::filesystem::path& file, const std::optional<std::filesystem::path>& config) {
             return api::Recording(file, config.value_or(std::filesystem::path()));
           }),
           py::arg("file"), py::arg("config") = py::none())
      .def_property_readonly("ports", &api::Recording::ports)
      .def_property_readonly("remarks", &api::Recording::remarks)
      .def("configuration", &api::Recording::configuration)
      .def("arrays", &read_arrays, py::arg("progress") = py::none(),
           "All samples: {kind: {column: numpy array}}. Absent numbers are NaN; times are ns since 1970 UTC.");
  py::class_<api::Pipeline>(module, "Pipeline", "Bytes of serial ports to samples.")
      .def(py::init([](const std::filesystem::path& config) { return api::Pipeline::from_file(config); }),
           py::arg("config"))
      .def_static(
          "from_text", [](const std::string& toml) { return api::Pipeline::from_text(toml); }, py::arg("toml"))
      .def_property_readonly("ports", &api::Pipeline::ports)
      .def(
          "push",
          [](api::Pipeline& pipeline, const std::string& port, std::int64_t arrival_ns, const py::bytes& bytes) {
            const auto view = static_cast<std::string_view>(bytes);
            return arrays_of(pipeline.push(pipeline.port(port), arrival_ns,
                                           {reinterpret_cast<const std::uint8_t*>(view.data()), view.size()}));
          },
          py::arg("port"), py::arg("arrival_ns"), py::arg("bytes"))
      .def(
          "advance",
          [](api::Pipeline& pipeline, std::int64_t now_ns) { return arrays_of(pipeline.advance(now_ns)); },
          py::arg("now_ns"));
}

void bind_calibration(py::module_& module) {
  py::class_<api::Quantity> quantity(module, "Quantity", "One number of an estimate.");
  NAVCAL_READ_MEMBERS(quantity, name, value, std_error)
  py::class_<api::CalibratorResult> result(module, "CalibratorResult",
                                           "The estimate of one calibrator and its judgement.");
  NAVCAL_READ_MEMBERS(result, name, verdict, judgement, accepted, reason, manoeuvre, coverage, condition, samples,
                      estimate)
  py::class_<api::Calibration> calibration(module, "Calibration", "The answer of calibrate().");
  NAVCAL_READ_MEMBERS(calibration, calibrators, duration_s, remarks, json)
  calibration.def("as_dict", [](const api::Calibration& answer) { return loads(answer.json); });
  module.def(
      "calibrate",
      [](const std::vector<std::filesystem::path>& files, const std::optional<std::filesystem::path>& config,
         const py::object& progress) {
        api::CalibrateOptions options;
        options.config = config.value_or(std::filesystem::path());
        options.progress = relay_to(progress);
        const py::gil_scoped_release unlocked;
        return api::calibrate(files, options);
      },
      py::arg("files"), py::arg("config") = py::none(), py::arg("progress") = py::none(),
      "Calibrates compass and gyros by recordings in order of time.");
}

/// Sets a member from a keyword of a call, if it was given.
template <class Value>
void take(py::kwargs& keywords, const char* name, Value& member) {
  if (!keywords.contains(name)) return;
  const py::object given = keywords.attr("pop")(name);
  if (given.is_none()) return;
  member = given.cast<Value>();
}

void expect_none_left(const py::kwargs& keywords, const char* function) {
  for (const auto& [name, value] : keywords) {
    throw py::type_error(std::string(function) + "() has no argument '" + name.cast<std::string>() + "'");
  }
}

void bind_simulation(py::module_& module) {
  module.def(
      "simulate",
      [](const std::filesystem::path& capture, const py::object& progress, py::kwargs keywords) {
        api::SimulateOptions options;
        std::map<std::string, double> effects, clocks;
        std::optional<std::array<double, 3>> place;
        NAVCAL_TAKE_MEMBERS(options, mission, drive, path, vehicle, config)
        take(keywords, "effects", effects);
        take(keywords, "effects_file", options.effects_file);
        take(keywords, "clocks", clocks);
        take(keywords, "seconds", options.seconds);
        take(keywords, "place", place);
        NAVCAL_TAKE_MEMBERS(options, field_uT, date, seed, noise, truth)
        expect_none_left(keywords, "simulate");
        for (const auto& [name, strength] : effects) options.effects.push_back({name, strength});
        for (const auto& [port, rate] : clocks) options.clocks.push_back({port, rate});
        if (place) options.place = api::Place{(*place)[0], (*place)[1], (*place)[2]};
        options.progress = relay_to(progress);
        const py::gil_scoped_release unlocked;
        return api::simulate(capture, options).remarks;
      },
      py::arg("capture"), py::arg("progress") = py::none(),
      "Simulates a mission and writes its recording. Keywords: the members of SimulateOptions; effects and clocks "
      "are dictionaries, place is (latitude_deg, longitude_deg, height_m). Returns remarks.");
}

/// One recording, or a sequence of them.
std::vector<std::filesystem::path> recordings_of(const py::object& given) {
  const bool is_one = py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__");
  if (is_one) return {given.cast<std::filesystem::path>()};
  return given.cast<std::vector<std::filesystem::path>>();
}

void take_diagnosis(py::kwargs& keywords, api::DiagnoseOptions& options) {
  NAVCAL_TAKE_MEMBERS(options, holdouts, nominals, steady, vehicle, config, field_uT, exclude, without, bank, seed,
                      cache, threads)
}

void bind_diagnosis(py::module_& module) {
  py::class_<api::EffectParameter> parameter(module, "EffectParameter", "A parameter of an effect.");
  NAVCAL_READ_MEMBERS(parameter, name, value, std_error)
  py::class_<api::Effect> effect(module, "Effect", "An effect as a cause.");
  NAVCAL_READ_MEMBERS(effect, name, of, probability, parameters)
  py::class_<api::Diagnosis> diagnosis(module, "Diagnosis", "The answer of diagnose().");
  diagnosis.def_property_readonly("verdict", [](const api::Diagnosis& answer) {
    constexpr std::array kNames{"no-gap", "explained", "unknown"};
    return kNames.at(static_cast<std::size_t>(answer.verdict));
  });
  NAVCAL_READ_MEMBERS(diagnosis, sentence, effects, candidates, unexplained, next, remarks, duration_s, seconds,
                      json, effects_toml, layout_toml)
  diagnosis.def("as_dict", [](const api::Diagnosis& answer) { return loads(answer.json); });
  module.def(
      "diagnose",
      [](const py::object& missions, const py::object& progress, py::kwargs keywords) {
        const std::vector<std::filesystem::path> recordings = recordings_of(missions);
        api::DiagnoseOptions options;
        take_diagnosis(keywords, options);
        expect_none_left(keywords, "diagnose");
        options.progress = relay_to(progress);
        const py::gil_scoped_release unlocked;
        return api::diagnose_together(recordings, options);
      },
      py::arg("missions"), py::arg("progress") = py::none(),
      "Diagnoses where and why a recording departs from the model; several of one vehicle are diagnosed together. "
      "Keywords: the members of DiagnoseOptions.");
}

void bind_next_mission(py::module_& module) {
  py::class_<api::NextMission> next(module, "NextMission", "The answer of plan_next_mission().");
  NAVCAL_READ_MEMBERS(next, decides, probability_now, probability_exact, duration_s, manoeuvres, sentence, remarks,
                      mission_toml, json, page)
  next.def("as_dict", [](const api::NextMission& answer) { return loads(answer.json); });
  module.def(
      "plan_next_mission",
      [](const py::object& missions, const py::object& progress, py::kwargs keywords) {
        const std::vector<std::filesystem::path> recordings = recordings_of(missions);
        api::NextMissionOptions options;
        take_diagnosis(keywords, options.diagnosis);
        NAVCAL_TAKE_MEMBERS(options, minutes, limits, mission_out)
        expect_none_left(keywords, "plan_next_mission");
        options.diagnosis.progress = relay_to(progress);
        const py::gil_scoped_release unlocked;
        return api::plan_next_mission(recordings, options);
      },
      py::arg("missions"), py::arg("progress") = py::none(),
      "Plans the mission that tells best what a diagnosis leaves open. Keywords: the members of DiagnoseOptions "
      "and of NextMissionOptions.");
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() =
      "Recordings of small underwater vehicles: samples, calibration, simulation, diagnosis (libnavcal).";
  module.attr("__version__") = api::version();
  bind_errors(module);
  bind_samples(module);
  bind_calibration(module);
  bind_simulation(module);
  bind_diagnosis(module);
  bind_next_mission(module);
}
