"""A scene of a run for ParaView: the drop coloured by its speed, the solid by a stress, particles as discs of their size.

    pvbatch cases/view/paraview_scene.py RUN --picture scene.png [--time MS]     a picture
    pvbatch cases/view/paraview_scene.py RUN --film film.avi                     all snapshots
    pvbatch cases/view/paraview_scene.py RUN --state scene.pvsm                  a state that ParaView opens (File, Load State)

It needs ParaView's Python (Debian: paraview, python3-paraview).
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from paraview import simple

MATERIALS = (("drop", 0, "velocity", "speed (m/s)", "Viridis (matplotlib)"),
             ("solid", 1, "stress_xx", "stress xx (Pa)", "Cool to Warm"))


def particles_of(reader: object, material: int, name: str) -> object:
    """Those of one material, as a source of its own with a name in the pipeline."""
    chosen = simple.Threshold(registrationName=name, Input=reader)
    chosen.Scalars = ["POINTS", "material"]
    chosen.LowerThreshold = chosen.UpperThreshold = material
    return chosen


def show(view: object, source: object, field: str, title: str, colours: str, diameter: float,
         place: float) -> None:
    display = simple.Show(source, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Plain circle"
    display.GaussianRadius = 0.5 * diameter
    simple.ColorBy(display, ("POINTS", field, "Magnitude") if field == "velocity" else ("POINTS", field))
    table = simple.GetColorTransferFunction(field)
    table.ApplyPreset(colours, True)
    display.RescaleTransferFunctionToDataRangeOverTime()
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle, bar.Visibility = title, "", 1
    bar.Orientation, bar.WindowLocation, bar.ScalarBarLength = "Horizontal", "Any Location", 0.3
    bar.Position = [place, 0.06]
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    bar.TitleFontSize = bar.LabelFontSize = 13


def scene(run: Path) -> object:
    """The view of the whole run, standing at its first snapshot."""
    simple._DisableFirstRenderCameraReset()
    # By its name, for ParaView before 5.12 does not know the ending.
    reader = simple.VTKHDFReader(registrationName="snapshots", FileName=[str(run / "snapshots.vtkhdf.series")])
    reader.UpdatePipeline()
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewSize = [1280, 640]
    view.InteractionMode = "2D"
    view.UseColorPaletteForBackground, view.Background = 0, [1, 1, 1]
    view.OrientationAxesVisibility = 0
    points = reader.GetDataInformation()
    present = {points.GetPointDataInformation().GetArrayInformation(k).GetName()
               for k in range(points.GetPointDataInformation().GetNumberOfArrays())}
    # A disc as large as a particle of the lattice.
    low_mass, density = reader.PointData["mass"].GetRange()[0], reader.PointData["density"].GetRange()[1]
    diameter = (low_mass / density) ** 0.5 * 1.13
    for name, material, field, title, colours in MATERIALS:
        low, high = reader.PointData["material"].GetRange()
        if low <= material <= high and field in present:
            show(view, particles_of(reader, material, name), field, title, colours, diameter, 0.1 + 0.45 * material)
    view.ResetCamera(True)
    return view


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=Path, help="folder of the results")
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--time", type=float, metavar="MS", help="of the picture, in ms (default: the middle of the run)")
    parser.add_argument("--film", type=Path)
    parser.add_argument("--state", type=Path)
    chosen = parser.parse_args()
    view = scene(chosen.run.resolve())
    times = [entry["time"] for entry in json.loads((chosen.run / "snapshots.vtkhdf.series").read_text())["files"]]
    animation = simple.GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    wanted = times[len(times) // 2] if chosen.time is None else chosen.time / 1e3
    animation.AnimationTime = min(times, key=lambda time: abs(time - wanted))
    simple.Render(view)
    if chosen.state:
        simple.SaveState(str(chosen.state))
    if chosen.picture:
        simple.SaveScreenshot(str(chosen.picture), view)
    if chosen.film:
        simple.SaveAnimation(str(chosen.film), view)


if __name__ == "__main__":
    main()
