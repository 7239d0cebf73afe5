#!/bin/bash
# Makes the README's pictures again: app/gallery/make.sh [FOLDER], the folder with the data sets that
# the project does not ship (app/gallery/README.md says where they are from). What is not there is
# skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# Under a name of the project's own: with --portable a picture keeps nothing but the path from its own
# folder, which then says nothing of the machine that it was made on.
data=out/gallery_data
mkdir -p out
rm -f "$data"
if (($# > 0)); then ln -s "$(realpath "$1")" "$data"; fi
picture() {
    local file=$1 out=app/gallery/$2; shift 2
    if [[ -f $file ]]; then ./run --with-vtk render "$file" --portable -o "$out" "$@"; else echo "skipped: $out needs $file"; fi
}

picture datasets/pool_fire_T.nc pool_fire.png --size 1000x750 --step 14 \
    --range 320:400 --color '#5b9bd5' --opacity 0.05 \
    --range 600:1000 --color '#e0562b' --opacity 0.12 \
    --range 1000:max --color '#ffe08a' --opacity 0.5
picture datasets/pool_fire_T.nc pool_fire_stereo.png --step 14 --size 700x700 \
    --range 500:max --colormap inferno --opacity 0.2 --stereo side-by-side
for model in points cells; do
    picture datasets/pool_fire_T.nc "pool_fire_$model.png" --step 14 --size 600x600 \
        --range 850~5 --color '#ffb15c' --opacity 0.8 --model "$model"
done
picture "$data/woa_temp_monthly_f32.nc" ocean.png --size 1000x750 --step 7 --view 0,40 \
    --range 18:22 --color '#56b4e9' --opacity 0.12 \
    --range 28:max --color '#e69f00' --opacity 0.5 --scale 1,1,0.06
picture "$data/viscous_fingers_demo.nc" viscous_fingers.png --size 1000x750 --step 12 --view 25,12 \
    --range 15:60 --colormap viridis --opacity 0.06 \
    --range 60:max --color '#e69f00' --opacity 0.08
picture "$data/viscous_fingers_demo.nc" viscous_fingers_stereo.png --step 12 \
    --view 25,12 --size 700x700 --range 25~5 --colormap cividis --opacity 0.1 --stereo side-by-side
picture "$data/echam_rhumidity_gaussian_3d.nc" humidity.png --size 1000x750 --view 0,50 \
    --range 0.95:max --colormap viridis --opacity 0.35 --scale 1,1,0.0004
picture "$data/echam_rhumidity_gaussian_3d.nc" humidity_globe.png --map globe --size 1000x750 --view 110,25 \
    --range 0.95:max --colormap viridis --opacity 0.35
picture "$data/grids/icon_ocean_triangles.nc" ocean_of_triangles_globe.png --map globe --variable S --size 1000x750 --view 60,25 \
    --range 33:37.5 --colormap viridis --opacity 0.5
currents=(--range min:-0.08,0.08:max --colormap cool-warm=-0.3:0.3 --opacity 0.5 --size 1000x750)
picture "$data/nemo_northsea_u.nc" currents_globe.png --map globe --view 0,62,2.1 --target -0.3,0.05,0.1 "${currents[@]}"
picture "$data/nemo_northsea_u.nc" currents.png --view 0,65,2.2 --target -0.3,0.1,0.2 "${currents[@]}"
picture "$data/bluntfin/bluntfin.vts" bluntfin.png --size 1000x750 --view 25,22 --range 1.6:max --colormap viridis --opacity 0.35
picture "$data/grids/wrf_mercator_moving_nest.nc" moving_nest.png --variable QRAIN --size 1000x750 --view 20,25 --step 2
picture "$data/dambreak_amr/dambreak.pvd" dam_break.png --size 1000x750 --step 8 --view 25,22 --range 0.5:1 --color '#3aa0ff' --opacity 0.9 --light full
picture "$data/can.vtu" crushed_can.png --variable EQPS --size 1000x750 --view 15,28 --range 0.1:max --colormap inferno --opacity 0.5
picture "$data/disk_out_ref.ex2" hot_disk.png --size 1000x750 --view 30,18 --range 400~2,500~2,600~2,700~2,800~2 --colormap inferno=250:900 --opacity 0.35
picture "$data/mug_transient.e" mug.png --variable convected --step 10 --size 1000x750 --view 30,25 --range min:0.2 --colormap viridis --opacity 0.5
picture "$data/grids/icon_ocean_triangles.nc" ocean_of_triangles.png --variable S --size 1000x750 --view 10,50 --range 33:37.5 --colormap viridis --opacity 0.5 --scale 1,1,0.4
picture "$data/grids/warping_spheres.vtkhdf" warping_spheres.png --size 1000x750 --step 20 --view 25,20 --range min:max --colormap cool-warm --opacity 0.8
picture "$data/fmri_filtered_func_64t.nii.gz" brain.png --size 1000x750 --step 32 --view 25,25 --range 5000:max --colormap inferno --opacity 0.2
picture "$data/grids/emd_3001.map" density_map.png --size 1000x750 --view 30,15 --range 0.3:max --color '#3aa0ff' --opacity 0.6
picture "$data/grids/chombo3d/chombo3d.vtm" adaptive_mesh.png --size 1000x750 --range=-0.034~0.0004,-0.026~0.0004,-0.018~0.0004 --colormap viridis --opacity 0.45
picture "$data/grids/openpmd_femm_3d.h5" magnet.png --size 1000x750
picture "$data/colpex_theta_rotpole_hybridheight.nc" hills.png --size 1000x750 --step 3 --view 30,40 --range min:max --colormap viridis --opacity 0.95 --light full

# Over time.
for step in 02 06 12 20; do
    picture "$data/mug_transient.e" "over_time_mug_$step.png" --variable convected --step "$((10#$step))" --size 600x450 --view 30,25 --range min:0.2 --colormap viridis --opacity 0.5
done
for step in 00 07 14 20; do
    picture "$data/grids/warping_spheres.vtkhdf" "over_time_spheres_$step.png" --step "$((10#$step))" --size 600x450 --view 25,20 --range min:max --colormap cool-warm --opacity 0.8
done

# First looks: nothing is asked for, the program chooses.
for first in isabel_windspeed_4d.nrrd hipip_ironProt_68.vtk tooth_u8.nrrd headsq_quarter/quarter.nhdr \
    neghip/neghip.nhdr aneurism_256_u8.vti viscous_fingers/vf_run01.pvd pool_fire_vti/fire.pvd; do
    name=$(basename "${first%.*}")
    picture "$data/$first" "first_$name.png" --size 600x450
done
