MODULE Welding
  ! poseshift compensated this file (version 0.1.0)
  ! profile 67a76cab2617a802fa5ea9e4da91307f2960c7860b954e2f6f80b0fcc588cb6b
  ! source 4e61bac5056c4a6e6902a8d767e03f227197b4f3564804d6c602c8ba64dc5143
    ! Bracket 4711, two torches on a changer. Branches and run-time data that nobody can tell from the text
    PERS tooldata tTorchS:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    PERS tooldata tTorchL:=[TRUE,[[0,0,128],[1,0,0,0]],[1.6,[0,4,63],[1,0,0,0],0,0,0]];
    PERS tooldata tAct:=[TRUE,[[0,0,96],[1,0,0,0]],[1.4,[0,4,52],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata wJig:=[FALSE,TRUE,"",[[360,-60,140],[0.994521895,0,0,-0.104528463]],[[0,0,0],[1,0,0,0]]];
    TASK PERS wobjdata wCam:=[FALSE,TRUE,"",[[360,-60,140],[0.994521895,0,0,-0.104528463]],[[0,0,0],[1,0,0,0]]];
    CONST robtarget p10:=[[1.010,-59.683,61.269],[0.023002,0.173202,-0.984604,0.005218],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p20:=[[6.143,-61.690,21.280],[0.023005,0.173164,-0.984611,0.005219],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p30:=[[31.061,-19.587,21.361],[0.040426,0.121353,-0.991770,0.005552],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p40:=[[34.997,24.482,23.388],[0.040695,0.051893,-0.997821,0.002041],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p50:=[[0.30,59.85,60.00],[0.017410,-0.069746,-0.997412,-0.001217],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p60:=[[-19.70,29.85,45.00],[0.017410,-0.069746,-0.997412,-0.001217],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p70:=[[-23.963,0.399,46.169],[0.014657,-0.026592,-0.999539,-0.000769],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget p80:=[[10.809,10.419,91.299],[0.032058,-0.026507,-0.999134,-0.001274],[-1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PERS robtarget pStart:=[[352.10,-41.30,188.70],[0,0,1,0],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR robtarget pHit;
    VAR bool bLong:=FALSE;

    PROC rWeld()
        ! fine: one torch, whatever the branch
        IF DI_TypeB=1 THEN
            tAct:=tTorchS;
            SetGO goProg,2;
        ELSE
            tAct:=tTorchS;
            SetGO goProg,1;
        ENDIF
        MoveJ p10,v500,z10,tAct\WObj:=wJig;
        MoveL p20,v200,fine,tAct\WObj:=wJig;
        MoveL p30,v20,z1,tAct\WObj:=wJig;
        MoveL p40,v20,fine,tAct\WObj:=wJig;
        ! refused: the long torch in one of the branches
        IF bLong THEN
            tAct:=tTorchL;
        ENDIF
        MoveL p50,v200,z10,tAct\WObj:=wJig;
        ! refused: a camera tells where the bracket lies
        wCam.oframe:=fLocate(4711);
        MoveL p60,v200,fine,tTorchS\WObj:=wCam;
        ! refused: the target is searched
        SearchL\Stop,diTouch,pHit,p70,v10,tTorchS\WObj:=wJig;
        pStart:=Offs(pHit,0,0,5);
        MoveL pStart,v20,fine,tTorchS\WObj:=wJig;
        MoveL p80,v200,z10,tTorchS\WObj:=wJig;
    ENDPROC

    LOCAL FUNC pose fLocate(num nType)
        VAR pose peFound;
        SocketSend skCam\Str:=ValToStr(nType);
        SocketReceive skCam\RawData:=rbCam;
        UnpackRawBytes rbCam,1,peFound.trans.x\Float4;
        RETURN peFound;
    ENDFUNC
ENDMODULE
