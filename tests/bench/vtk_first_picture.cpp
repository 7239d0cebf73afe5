// What a VTK user writes for the first picture of a range of a file: read, threshold, splats, PNG.
//
//     vtk_first_picture FILE.nrrd LO HI OUT.png      1200 x 900, as `isochron render` has it
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkThresholdPoints.h>
#include <vtkWindowToImageFilter.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    vtkNew<vtkNrrdReader> reader;
    reader->SetFileName(argv[1]);
    vtkNew<vtkThresholdPoints> points;
    points->SetInputConnection(reader->GetOutputPort());
    points->ThresholdBetween(std::atof(argv[2]), std::atof(argv[3]));
    vtkNew<vtkPointGaussianMapper> mapper;
    mapper->SetInputConnection(points->GetOutputPort());
    mapper->SetScaleFactor(
        0.5);  // of a step between neighbours: three of them are a splat's radius
    mapper->EmissiveOn();
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(1, 0.5, 0.1);
    actor->GetProperty()->SetOpacity(0.1);
    actor->ForceOpaqueOn();
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    vtkNew<vtkRenderWindow> window;
    window->SetMultiSamples(0);
    window->SetOffScreenRendering(1);
    window->SetSize(1200, 900);
    window->AddRenderer(renderer);
    renderer->GetActiveCamera()->SetPosition(-1, -2, 1);
    renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
    renderer->ResetCamera();
    window->Render();
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(window);
    picture->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(argv[4]);
    writer->SetCompressionLevel(1);
    writer->SetInputConnection(picture->GetOutputPort());
    writer->Write();
    std::printf("%lld points\n", static_cast<long long>(points->GetOutput()->GetNumberOfPoints()));
    return points->GetOutput()->GetNumberOfPoints() > 0 ? 0 : 1;
}
