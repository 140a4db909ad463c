namespace BepuPhysics.Constraints.Contact;

// What rests on what moves: each body that is carried moves along with what carries it.
unsafe partial struct SupportGraph
{
    // In the place of a floor: none, as those that carry the body move differently, or the body does not rest to them.
    const int None = int.MaxValue;

    // Who has a foot on what stands has nothing from the others, as if they were not there.
    readonly int FloorOf<TMotions>(int body, TMotions motions) where TMotions : struct, IFloors
    {
        int floor = None;
        var differ = false;
        for (int i = starts[body]; i < starts[body + 1]; ++i)
        {
            ref var support = ref byUpper[i];
            if (support.Leans || support.Sways || !IsBelow(support))
                continue;
            var below = FloorBelow(support);
            if (below == SupportLink.Still)
            {
                if (!support.Moves)
                    return SupportLink.Still;
            }
            else if (floor == None)
                floor = below;
            else
                differ |= below != None && !MoveAlike(floor, below, motions);
        }
        return floor == None || differ || !motions.RestsOn(body, SupportLink.Floor(floor)) ? None : floor;
    }

    static bool MoveAlike<TMotions>(int floor, int other, TMotions motions) where TMotions : struct, IFloors =>
        floor == other || motions.MoveAlike(SupportLink.Floor(floor), SupportLink.Floor(other));

    readonly int FloorBelow(in Support support) => support.Lower < 0 ? support.Lower : floors[support.Lower];

    readonly bool IsOnFloor(int body) => grounded[body] != 0 && floors[body] < SupportLink.Still;

    // Floors that move differently are not among those that carry: their body has none then.
    readonly bool SharesFloor(in Support support) => floors[support.Upper] switch
    {
        None => false,
        SupportLink.Still => FloorBelow(support) == SupportLink.Still && !support.Moves,
        _ => FloorBelow(support) < SupportLink.Still,
    };
}
