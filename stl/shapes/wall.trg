/*
 * wall - a wall of bricks in running bond: each row is shifted by half a brick.
 *
 * Lengths are metres. All bricks share one mesh and a few shades of the colour.
 *
 *   shapes::brick_wall(length = 4, height = 2, brick = vec3(0.24, 0.07, 0.115), colour, seed = 1)
 *       length, height   along X and Y; the height is rounded to whole rows
 *       brick            length, height and depth of one brick; joints are a fifth of its height
 *       colour           linear RGB
 *       seed             chooses the shades
 *   Returns a group (stl/group.trg), centred on x = 0, z = 0, standing on y = 0.
 *
 * Use:
 *
 *   include("stl/shapes/wall.trg");
 *   Scene = scene();
 *   shapes::brick_wall(4, 1.5).AddTo(Scene);
 *   corner = shapes::brick_wall(3, 1.5, vec3(0.24, 0.07, 0.115), vec3(0.5, 0.4, 0.25));
 *   corner.Rotate(vec3(0, 1, 0), 90).Move(vec3(2.1, 0, 1.4)).AddTo(Scene);
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.Add(dir_light(vec3(-5, 6, 4), vec3(1, 1, 1)));
 *   Scene.CamSet(640, 360, vec3(-1, 2, 5), vec3(0.3, 0.7, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/group.trg");
include("stl/random.trg");

shapes::brick_wall = function(length = 4 ~ "num", height = 2 ~ "num",
    brick = vec3(0.24, 0.07, 0.115) ~ "vec3",
    colour = vec3(0.42, 0.11, 0.06) ~ "vec3", seed = 1 ~ "num")
{
    joint = brick.y * 0.2;
    pitch = brick.x + joint;
    rows = mth::max(1, mth::floor(height / (brick.y + joint) + 0.5));
    whole = group::make();
    mortar = box(vec3(-length / 2, 0, -brick.z * 0.42) + vec3(joint, 0, 0),
        vec3(length / 2, rows * (brick.y + joint), brick.z * 0.42) - vec3(joint, joint, 0),
        material::pbr(vec3(0.6, 0.57, 0.52), 0, 0.1));
    whole.Put(mortar);

    dice = random::make(seed);
    shades = shapes::brick_shades(colour);
    cube = box(vec3(-0.5, 0, -0.5), vec3(0.5, 1, 0.5));
    for (row = 0; row < rows; row++)
    {
        /* Bricks are cut where the wall ends. */
        left = -length / 2 - (row % 2) * pitch / 2;
        for (k = 0; left + k * pitch < length / 2; k++)
        {
            from = mth::max(left + k * pitch, -length / 2);
            to = mth::min(left + k * pitch + brick.x, length / 2);
            mtl = shades[mth::floor(dice.Next(0, 5))];
            if (to - from > joint)
            {
                piece = cube.Copy().Scale(vec3(to - from, brick.y, brick.z)).Material(mtl);
                whole.Put(piece.Move(vec3((from + to) / 2, row * (brick.y + joint), 0)));
            }
        }
    }
    return whole;
};

/* Five materials from dark to light. */
shapes::brick_shades = function(colour ~ "vec3")
{
    shades = [];
    for (k = 0; k < 5; k++)
        shades.append(material::pbr(colour * (0.6 + 0.15 * k), 0, 0.2));
    return shades;
};
