/*
 * group - several shapes that are handled as one.
 *
 * The functions of stl/shapes.trg return a group: built round the origin, standing on y = 0, not yet
 * in the scene. Lengths are metres, angles degrees.
 *
 *   group::make()            an empty group
 *   g.Put(shape)             takes a shape in and returns it
 *   g.Move(by)  g.Rotate(axis, degrees)  g.Scale(by)  g.Material(mtl)
 *                            do so with every part and return g; the axis runs through (0, 0, 0)
 *   g.Copy()                 another group; its shapes share the meshes of these
 *   g.AddTo(Scene)           puts every part into the scene and returns g
 *   g.parts                  the list of its shapes
 *
 * Use:
 *
 *   include("stl/group.trg");
 *   Scene = scene();
 *   lamp = group::make();
 *   lamp.Put(cylinder(vec3(0), 0.1, 2, material::black_plastic()));
 *   lamp.Put(sphere(vec3(0, 2.2, 0), 0.3, material::emission(vec3(1, 0.8, 0.5), 4)));
 *   lamp.Copy().Move(vec3(3, 0, 0)).AddTo(Scene);
 *   lamp.AddTo(Scene);
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.CamSet(640, 360, vec3(1, 3, 8), vec3(1, 1, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */

group::make = function()
{
    made = object();
    made.parts = [];
    made.Put = group::put;
    made.Move = group::move;
    made.Rotate = group::rotate;
    made.Scale = group::scale;
    made.Material = group::material;
    made.Copy = group::copy;
    made.AddTo = group::add_to;
    return made;
};

group::put = function(self ~ "object", part ~ "shape")
{
    self.parts.append(part);
    return part;
};

group::move = function(self ~ "object", by ~ "vec3")
{
    for (part in self.parts)
        part.Move(by);
    return self;
};

group::rotate = function(self ~ "object", axis ~ "vec3", degrees ~ "num")
{
    for (part in self.parts)
        part.Rotate(axis, degrees);
    return self;
};

group::scale = function(self ~ "object", by)
{
    for (part in self.parts)
        part.Scale(by);
    return self;
};

group::material = function(self ~ "object", mtl ~ "material")
{
    for (part in self.parts)
        part.Material(mtl);
    return self;
};

group::copy = function(self ~ "object")
{
    made = group::make();
    for (part in self.parts)
        made.Put(part.Copy());
    return made;
};

group::add_to = function(self ~ "object", Scene ~ "scene")
{
    for (part in self.parts)
        Scene.Add(part);
    return self;
};
